# Compile options shared by every target, and the function that makes one library of one folder.

add_library(towbench_options INTERFACE)
target_include_directories(towbench_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(towbench_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor
  -Wold-style-cast -Woverloaded-virtual -Wundef
  -Werror
  # Same bits on every machine and build type: no fused multiply-add, no reassociation.
  -ffp-contract=off -fno-fast-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105651: a false -Wrestrict inside std::string's operator+ at -O2 and above.
  target_compile_options(towbench_options INTERFACE -Wno-restrict)
endif()
# GCC collects garbage from 128 MB on. Where there is memory, a build is a fifteenth quicker without it.
cmake_host_system_information(RESULT memory_MB QUERY TOTAL_PHYSICAL_MEMORY)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND memory_MB GREATER 7500)
  target_compile_options(towbench_options INTERFACE
    $<$<COMPILE_LANGUAGE:C,CXX>:--param=ggc-min-heapsize=1048576>)
endif()
if(TOWBENCH_SANITIZE)
  target_compile_options(towbench_options INTERFACE
    -fsanitize=${TOWBENCH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(towbench_options INTERFACE -fsanitize=${TOWBENCH_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Under sanitizers GCC takes instrumented library code (std::regex) for uninitialised; the
    # release build, without them, keeps the warning. Asio's fences are unknown to the thread
    # sanitizer; its mutexes, which order the same data, are known.
    target_compile_options(towbench_options INTERFACE -Wno-maybe-uninitialized -Wno-tsan)
  endif()
endif()

if(TOWBENCH_FUZZ)
  # What a fuzz target runs through reports its coverage; tests/fuzz adds the fuzzer's own main. A target with
  # TOWBENCH_NOT_FUZZED does not, and compiles a fifth faster.
  target_compile_options(towbench_options INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:TOWBENCH_NOT_FUZZED>>>:-fsanitize=fuzzer-no-link>
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(towbench_options INTERFACE -fsanitize=address,undefined)
endif()

# A build is mostly the parsing of headers, so sources of one library are compiled a few at a time.
# TOWBENCH_UNITY=OFF compiles each alone: for clang-tidy, and so that a missing include is still an
# error (`./towbench test --only alone`).
set(CMAKE_UNITY_BUILD ${TOWBENCH_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 20)

# towbench_library(NAME [DEPENDS targets...] [FOLDERS names...] [EXCLUDE regex...] [ALONE files...]):
# every .cc below the calling folder, or below those of its folders. ALONE: files that no other may
# share a unit with (system headers that clash, register names that every peripheral has).
function(towbench_library name)
  cmake_parse_arguments(arg "" "" "DEPENDS;FOLDERS;EXCLUDE;ALONE" ${ARGN})
  set(patterns ${arg_FOLDERS})
  list(TRANSFORM patterns PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(NOT arg_FOLDERS)
    set(patterns ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  list(TRANSFORM patterns APPEND /*.cc)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  foreach(pattern IN LISTS arg_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC towbench_options ${arg_DEPENDS})
    set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE towbench_options ${arg_DEPENDS})
  endif()
endfunction()

# towbench_program(TARGET): what a user starts lies in bin/, beside its siblings (harness/commands/sibling.cc).
function(towbench_program target)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endfunction()

# towbench_test(NAME DEPENDS targets...): one GoogleTest program of the calling folder.
function(towbench_test name)
  cmake_parse_arguments(arg "" "" "DEPENDS;EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  foreach(pattern IN LISTS arg_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  set_target_properties(${name} PROPERTIES TOWBENCH_NOT_FUZZED ON)
  # Test code is compiled often and run once; what it tests keeps its own optimisation and its line numbers.
  if(TOWBENCH_FUZZ OR TOWBENCH_SANITIZE)
    target_compile_options(${name} PRIVATE -O0 -g0)
  else()
    target_compile_options(${name} PRIVATE -O1)
  endif()
  target_link_libraries(${name} PRIVATE towbench_options ${arg_DEPENDS}
    GTest::gmock GTest::gtest GTest::gtest_main)
  gtest_discover_tests(${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} DISCOVERY_TIMEOUT 60
    DISCOVERY_MODE PRE_TEST
    # Keys of run folders are made here, not in the state of whoever runs the tests. Freed memory is
    # kept, as in study/main.cc.
    PROPERTIES ENVIRONMENT
      "XDG_STATE_HOME=${CMAKE_BINARY_DIR}/state"
      MALLOC_MMAP_THRESHOLD_=33554432 MALLOC_TRIM_THRESHOLD_=1073741824 MALLOC_TOP_PAD_=67108864)
endfunction()
