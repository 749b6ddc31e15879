# SPDX-License-Identifier: Apache-2.0
# sonar_room(NAME [ONE_TEST] ROOMS r1 r2 ... LIBRARIES l1 ... PRIVATE_LIBRARIES p1 ...)
# One library a room: every .cpp beside the CMakeLists.txt and below it, but the *_test.cpp, which make the room's unit
# tests. ONE_TEST: they run as one, because what they share costs more than they do. The include root is src/, so that a
# room is named in every include and the layer check can read it.
include(GoogleTest OPTIONAL)

function(sonar_room name)
  cmake_parse_arguments(ROOM "ONE_TEST" "" "ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ROOM_ROOMS PREPEND sonar_)
  add_library(sonar_${name} STATIC ${sources})
  add_library(sonar::${name} ALIAS sonar_${name})
  target_include_directories(sonar_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(sonar_${name} PUBLIC ${ROOM_ROOMS} ${ROOM_LIBRARIES} PRIVATE sonar_options ${ROOM_PRIVATE_LIBRARIES})
  if(SONAR_TESTS AND tests)
    add_executable(sonar_${name}_test ${tests})
    target_link_libraries(sonar_${name}_test PRIVATE sonar_${name} sonar_test_options GTest::gtest_main)
    if(ROOM_ONE_TEST)
      add_test(NAME ${name} COMMAND sonar_${name}_test --gtest_brief=1)
      set_tests_properties(${name} PROPERTIES LABELS unit ENVIRONMENT "SONAR_SOURCE=${PROJECT_SOURCE_DIR}")
      return()
    endif()
    gtest_discover_tests(sonar_${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS unit ENVIRONMENT "SONAR_SOURCE=${PROJECT_SOURCE_DIR}")
  endif()
endfunction()
