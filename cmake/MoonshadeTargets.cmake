# moonshade_library(NAME SOURCES ... [DEPENDS ...]): the library of the current folder, target ms_NAME.
#
# Headers are included by their path from the repository's root ("compiler/base/source.h"), but each library publishes
# only its own folder, through a link in the build tree: an include from a library that is not in DEPENDS (or below it)
# does not compile.
function(moonshade_library NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(root ${CMAKE_BINARY_DIR}/include/${NAME})
  get_filename_component(parent ${root}/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${folder} SYMBOLIC)
  add_library(ms_${NAME} STATIC ${ARG_SOURCES})
  target_include_directories(ms_${NAME} PUBLIC ${root})
  foreach(dependency ${ARG_DEPENDS})
    target_link_libraries(ms_${NAME} PUBLIC ms_${dependency})
  endforeach()
endfunction()

# moonshade_test(NAME SOURCES ... DEPENDS ...): a GoogleTest program, ms_NAME_test, each of its tests a test of ctest.
function(moonshade_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(ms_${NAME}_test ${ARG_SOURCES})
  foreach(dependency ${ARG_DEPENDS})
    target_link_libraries(ms_${NAME}_test PRIVATE ms_${dependency})
  endforeach()
  target_link_libraries(ms_${NAME}_test PRIVATE GTest::gtest GTest::gmock GTest::gtest_main)
  gtest_discover_tests(ms_${NAME}_test TEST_PREFIX "${NAME}." DISCOVERY_TIMEOUT 120)
endfunction()
