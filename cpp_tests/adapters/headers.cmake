# Each header compiles alone and twice, without a warning, with every compiler at hand, in C++17 and
# C++20, and in C++17 without exceptions where that is offered.
#
#   cmake -DCOMPILERS=c++,clang++ -DINCLUDE=... -DHEADERS=netmesh.hpp,... -DSYSTEM_INCLUDES=...
#         -DSCRATCH=... -P headers.cmake

string(REPLACE "," ";" compilers "${COMPILERS}")
string(REPLACE "," ";" headers "${HEADERS}")
string(REPLACE "," ";" system_includes "${SYSTEM_INCLUDES}")
list(TRANSFORM system_includes PREPEND "-isystem")
file(MAKE_DIRECTORY "${SCRATCH}")

set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror)
foreach(header IN LISTS headers)
  set(unit "${SCRATCH}/unit.cpp")
  file(WRITE "${unit}" "#include <${header}>\n#include <${header}>\n")
  set(modes "-std=c++17" "-std=c++20")
  if(header MATCHES "strided")  # and with it netmesh.hpp
    list(APPEND modes "-std=c++17 -fno-exceptions")
  endif()
  foreach(compiler IN LISTS compilers)
    foreach(mode IN LISTS modes)
      message(STATUS "${header} ${compiler} ${mode}")
      separate_arguments(mode)
      execute_process(
        COMMAND "${compiler}" ${mode} ${warnings} "-I${INCLUDE}" ${system_includes} -fsyntax-only "${unit}"
        COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
  endforeach()
endforeach()
