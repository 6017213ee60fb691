# `./towbench package`: a .deb that needs no compiler. The three programs lie together in lib/towbench,
# with the fixtures above them where they look for them; /usr/bin/towbench is a link to the bench.
set(home lib/towbench)
install(TARGETS towbench-bench towbench-panel towbench-study DESTINATION ${home})
install(TARGETS axis_fmu DESTINATION ${home})
install(DIRECTORY fixtures DESTINATION share/towbench)
install(DIRECTORY docs/ DESTINATION share/doc/towbench/docs)
install(FILES README.md DESTINATION share/doc/towbench)
install(DIRECTORY clients/plant DESTINATION share/towbench)
install(CODE "
  set(to \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  file(MAKE_DIRECTORY \${to}/bin)
  file(CREATE_LINK ../lib/towbench/towbench-bench \${to}/bin/towbench SYMBOLIC)
  file(CREATE_LINK ../../share/towbench/fixtures \${to}/${home}/fixtures SYMBOLIC)
  execute_process(COMMAND bash ${CMAKE_SOURCE_DIR}/tools/package_texts.sh ${CMAKE_SOURCE_DIR} \${to} ${PROJECT_VERSION}
    COMMAND_ERROR_IS_FATAL ANY)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME towbench)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "towbench maintainers <authors@towbench.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "hardware-in-the-loop bench for embedded motion controllers")
set(CPACK_PACKAGE_DESCRIPTION "Emulates a machine (drive, transmission, friction, water, encoders,
switches) for an unmodified motion controller, scripts and judges
experiments, injects faults, and diagnoses measured logs.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
