# A run over a pseudo-terminal needs both of its processes served in time: it takes the room of two
# tests, so that one other test at most runs beside it.
foreach(name IN LISTS test_harness_TESTS)
  if(name MATCHES "over_a_line|^SerialLine|^SerialConsole|ACaseGivesTheSameLine|OverEachCarrier|OnTheLine|BaudMismatch|SoundWires")
    set_tests_properties("${name}" PROPERTIES PROCESSORS 2)
  endif()
endforeach()
