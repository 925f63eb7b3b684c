/*
 * The function whose argument only mpi.h knows.
 */
#include "netmesh_mpi.h"

nm_status netmesh_mpi_run(const MPI_Comm *communicator, uint32_t dim, uint64_t local_count,
                          const double *points, const nm_options *options, nm_mpi_mesh **mesh);

nm_status nm_mpi_run(MPI_Comm communicator, uint32_t dim, uint64_t local_count, const double *points,
                     const nm_options *options, nm_mpi_mesh **mesh)
{
    return netmesh_mpi_run(&communicator, dim, local_count, points, options, mesh);
}
