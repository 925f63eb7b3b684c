# The shared library exports what symbols.txt lists, which is what the header declares, and nothing
# else: a symbol that appears is ABI from then on, one that goes breaks programs.
#
#   cmake -DNM=... -DLIBRARY=... -DHEADER=... -DLIST=... -DREADELF=...
#         -DSONAME=... -P symbols.cmake

include("${CMAKE_CURRENT_LIST_DIR}/require_equal.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/NetmeshDeclared.cmake")

file(STRINGS "${LIST}" listed)

execute_process(COMMAND "${NM}" --dynamic --defined-only "${LIBRARY}"
                OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[0-9a-f]+ [A-Za-z] [^\n]+" exported "${text}")
list(TRANSFORM exported REPLACE "^[0-9a-f]+ [A-Za-z] " "")
list(SORT exported)
require_equal("${LIBRARY} exports" "${exported}" "${listed}")

declared_functions("${HEADER}" declared)
list(SORT declared)
require_equal("${HEADER} declares" "${declared}" "${listed}")

list(LENGTH listed count)
message(STATUS "${count} symbols, exported and declared")

execute_process(COMMAND "${READELF}" --dynamic "${LIBRARY}"
                OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "soname: \\[([^]\n]+)\\]" unused "${text}")
require_equal("${LIBRARY} is called" "${CMAKE_MATCH_1}" "${SONAME}")
