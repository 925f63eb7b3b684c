/*
 * The function whose argument only mpi.h knows. netmesh_mpi.h declares it too; that is made from the
 * library, which must so compile without it.
 */
#include "netmesh.h"

#include <mpi.h>

typedef struct nm_mpi_mesh nm_mpi_mesh;

nm_status netmesh_mpi_run(const MPI_Comm *communicator, uint32_t dim, uint64_t local_count,
                          const double *points, const nm_options *options, nm_mpi_mesh **mesh);

NM_API nm_status nm_mpi_run(MPI_Comm communicator, uint32_t dim, uint64_t local_count, const double *points,
                     const nm_options *options, nm_mpi_mesh **mesh)
{
    return netmesh_mpi_run(&communicator, dim, local_count, points, options, mesh);
}
