# The functions that a header declares, in its order: declarations begin at the first column, with NM_API or,
# on the line after it, with their type. Comments and struct members do not.
function(declared_functions header result)
  file(STRINGS "${header}" lines REGEX "^(NM_[A-Z]+ |[a-z]).*nm_[a-z_]+\\(")
  set(names "")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "(nm_[a-z_]+)\\(" unused "${line}")
    list(APPEND names "${CMAKE_MATCH_1}")
  endforeach()
  set(${result} "${names}" PARENT_SCOPE)
endfunction()
