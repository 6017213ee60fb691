# The report's page is built from reports/ and embedded, so that the executable is one file and a
# report needs nothing beside it.

# towbench_embed_report_assets(TARGET): gives TARGET the definitions of harness/report/assets.h.
# With TOWBENCH_REPORT_ASSETS the script is built by npm, in the build folder; without it the page
# keeps its words and numbers and says that it has no plots.
function(towbench_embed_report_assets target)
  set(source ${CMAKE_SOURCE_DIR}/reports)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cc)
  set(template ${source}/template.html)
  set(style ${source}/style.css)
  set(script "")
  if(TOWBENCH_REPORT_ASSETS)
    set(work ${CMAKE_BINARY_DIR}/reports)
    set(script ${work}/dist/report.js)
    towbench_build_report_script(${source} ${work} ${script})
  endif()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DTEMPLATE=${template} -DSTYLE=${style} -DSCRIPT=${script}
            -DOUTPUT=${output} -P ${CMAKE_SOURCE_DIR}/cmake/embed_report_assets.cmake
    DEPENDS ${template} ${style} ${script} ${CMAKE_SOURCE_DIR}/cmake/embed_report_assets.cmake
    COMMENT "Embedding the report's page" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

# Packages are installed again only when the lock file changes. The sources are copied because
# packages are found from where a source lies, and the source tree stays clean.
function(towbench_build_report_script source work script)
  find_program(TOWBENCH_NPM npm)
  if(NOT TOWBENCH_NPM)
    message(FATAL_ERROR "npm is missing; it builds the plots of the run report.\n"
      "Install it (Debian: apt-get install nodejs npm) or configure with "
      "-DTOWBENCH_REPORT_ASSETS=OFF for reports without plots.")
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${source}/src/*.ts)
  set(manifests ${source}/package.json ${source}/package-lock.json)
  set(installed ${work}/node_modules/.installed)
  add_custom_command(OUTPUT ${installed}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${work}
    COMMAND ${CMAKE_COMMAND} -E copy ${manifests} ${work}
    COMMAND ${TOWBENCH_NPM} ci --prefer-offline --ignore-scripts --no-audit --no-fund
            --loglevel=error --silent
    COMMAND ${CMAKE_COMMAND} -E touch ${installed}
    DEPENDS ${manifests} WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/reports
    COMMENT "Installing the report's npm packages from its lock file" VERBATIM)
  add_custom_command(OUTPUT ${script}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${work}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${source}/src ${work}/src
    COMMAND ${CMAKE_COMMAND} -E copy ${source}/tsconfig.json ${work}
    COMMAND ${TOWBENCH_NPM} run --silent check
    COMMAND ${TOWBENCH_NPM} run --silent build
    DEPENDS ${installed} ${sources} ${source}/tsconfig.json WORKING_DIRECTORY ${work}
    COMMENT "Building the report's script" VERBATIM)
  file(MAKE_DIRECTORY ${work})
endfunction()
