# Ends a test script where what was found is not what was expected; lists are shown line by line.
function(require_equal what found expected)
  if(NOT found STREQUAL expected)
    string(REPLACE ";" "\n  " found "${found}")
    string(REPLACE ";" "\n  " expected "${expected}")
    message(FATAL_ERROR "${what}:\n  ${found}\ninstead of\n  ${expected}")
  endif()
endfunction()
