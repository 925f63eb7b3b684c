# A locale with a decimal comma for the test `locale`, made where its sources are and kept in the build
# directory: images and continuous integration rarely have one installed.
find_program(NETMESH_LOCALEDEF localedef)
set(comma_locale_dir "${CMAKE_CURRENT_BINARY_DIR}/locales")
set(comma_locale_environment "")
if(NETMESH_LOCALEDEF AND EXISTS "/usr/share/i18n/locales/de_DE")
  if(NOT EXISTS "${comma_locale_dir}/de_DE.UTF-8/LC_NUMERIC")
    file(MAKE_DIRECTORY "${comma_locale_dir}")
    execute_process(
      COMMAND "${NETMESH_LOCALEDEF}" --inputfile de_DE --charmap UTF-8 "${comma_locale_dir}/de_DE.UTF-8"
      OUTPUT_QUIET ERROR_QUIET)
  endif()
  if(EXISTS "${comma_locale_dir}/de_DE.UTF-8/LC_NUMERIC")
    set(comma_locale_environment "LOCPATH=${comma_locale_dir}")
  endif()
endif()

add_executable(locale locale.c)
target_link_libraries(locale PRIVATE netmesh::netmesh)
netmesh_test(locale locale "${scratch_dir}")
set_tests_properties(locale PROPERTIES ENVIRONMENT "${comma_locale_environment}")
