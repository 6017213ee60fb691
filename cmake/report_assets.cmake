# The report's page is built from reports/ and embedded, so that the executable is one file and a
# report needs nothing beside it.

# towbench_embed_report_assets(TARGET): gives TARGET the definitions of harness/report/assets.h and
# harness/panel/panel_assets.h. With TOWBENCH_REPORT_ASSETS the scripts are built by npm, in the build
# folder; without it a report keeps its words and numbers and says that it has no plots, and there is
# no panel.
function(towbench_embed_report_assets target)
  set(source ${CMAKE_SOURCE_DIR}/reports)
  set(report "")
  set(panel "")
  if(TOWBENCH_REPORT_ASSETS)
    set(work ${CMAKE_BINARY_DIR}/reports)
    set(report ${work}/dist/report.js)
    set(panel ${work}/dist/panel.js)
    towbench_build_page_scripts(${source} ${work} ${report} ${panel})
  endif()
  towbench_embed_page(${target} report_assets harness/report/assets.h towbench::harness::report
    template_asset ${source}/template.html ${source}/style.css "${report}")
  towbench_embed_page(${target} panel_assets harness/panel/panel_assets.h towbench::harness::panel
    page_asset ${source}/panel.html ${source}/panel.css "${panel}")
endfunction()

function(towbench_embed_page target name header namespace page_function page style script)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -DNAMESPACE=${namespace}
            -DPAGE_FUNCTION=${page_function} -DPAGE=${page} -DSTYLE=${style} -DSCRIPT=${script}
            -DOUTPUT=${output} -P ${CMAKE_SOURCE_DIR}/cmake/embed_report_assets.cmake
    DEPENDS ${page} ${style} ${script} ${CMAKE_SOURCE_DIR}/cmake/embed_report_assets.cmake
    COMMENT "Embedding ${page}" VERBATIM)
  # A unit of its own: it is long, and changes with the page alone.
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${output})
endfunction()

# Packages are installed again only when the lock file changes. The sources are copied because
# packages are found from where a source lies, and the source tree stays clean.
function(towbench_build_page_scripts source work)
  set(scripts ${ARGN})
  find_program(TOWBENCH_NPM npm)
  if(NOT TOWBENCH_NPM)
    message(FATAL_ERROR "npm is missing; it builds the plots of the run report and the panel.\n"
      "Install it (Debian: apt-get install nodejs npm) or configure with "
      "-DTOWBENCH_REPORT_ASSETS=OFF for reports without plots.")
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${source}/src/*.ts ${source}/src/panel/*.ts)
  set(manifests ${source}/package.json ${source}/package-lock.json)
  set(installed ${work}/node_modules/.installed)
  add_custom_command(OUTPUT ${installed}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${work}
    COMMAND ${CMAKE_COMMAND} -E copy ${manifests} ${work}
    COMMAND ${TOWBENCH_NPM} ci --prefer-offline --ignore-scripts --no-audit --no-fund
            --loglevel=error --silent --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-timeout=20000
    COMMAND ${CMAKE_COMMAND} -E touch ${installed}
    DEPENDS ${manifests} WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/reports
    COMMENT "Installing the report's npm packages from its lock file" VERBATIM)
  add_custom_command(OUTPUT ${scripts}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${work}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${source}/src ${work}/src
    COMMAND ${CMAKE_COMMAND} -E copy ${source}/tsconfig.json ${work}
    COMMAND ${TOWBENCH_NPM} run --silent check
    COMMAND ${TOWBENCH_NPM} run --silent build
    DEPENDS ${installed} ${sources} ${source}/tsconfig.json WORKING_DIRECTORY ${work}
    COMMENT "Building the pages' scripts" VERBATIM)
  file(MAKE_DIRECTORY ${work})
endfunction()
