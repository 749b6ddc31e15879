# SPDX-License-Identifier: Apache-2.0
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # the rooms are part of a shared library too
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(SONAR_CCACHE ccache)
if(SONAR_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SONAR_CCACHE})
endif()

add_library(sonar_options INTERFACE)
# -ffp-contract=off: a fused multiply-add would make products differ between compilers and processors.
target_compile_options(sonar_options INTERFACE -ffp-contract=off -Wall -Wextra -Werror -Wshadow -Wconversion
                       -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wnull-dereference)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees null dereferences and uninitialised values in its own standard library once it inlines it.
  target_compile_options(sonar_options INTERFACE -Wno-null-dereference -Wno-maybe-uninitialized)
  # At -O3 it takes "text" + std::string for an overlap (GCC bug 105329), and the end of a vector for its middle.
  target_compile_options(sonar_options INTERFACE $<$<CONFIG:Release>:-Wno-restrict> $<$<CONFIG:Release>:-Wno-stringop-overflow>)
endif()
# What an attacker's file could make of a mistake of ours: overruns are caught, and neither the table of functions nor the
# stack can be written and run. No library is looked for beside where the system keeps them, and no program tells where it
# was built.
set(CMAKE_SKIP_RPATH ON)
target_compile_options(sonar_options INTERFACE -fstack-protector-strong -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
target_link_options(sonar_options INTERFACE LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack)
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcf-protection SONAR_HAS_CET)
if(SONAR_HAS_CET)
  target_compile_options(sonar_options INTERFACE -fcf-protection)
endif()
if(NOT SONAR_SANITIZE AND NOT CMAKE_BUILD_TYPE STREQUAL "Debug")  # it needs an optimiser, and hides from sanitizers
  target_compile_options(sonar_options INTERFACE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
endif()
if(SONAR_SANITIZE)
  target_compile_options(sonar_options INTERFACE -fsanitize=${SONAR_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sonar_options INTERFACE -fsanitize=${SONAR_SANITIZE})
endif()
if(SONAR_FUZZ)
  target_compile_options(sonar_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
# The files of tests: most is checked once, and -O2 makes a quarter of the time that it takes to compile them.
add_library(sonar_test_options INTERFACE)
target_link_libraries(sonar_test_options INTERFACE sonar_options GTest::gmock)
target_compile_options(sonar_test_options INTERFACE $<$<NOT:$<CONFIG:Debug>>:-O1>)
if(SONAR_PLAIN_THREADS)
  target_compile_definitions(sonar_options INTERFACE SONAR_PLAIN_THREADS)
endif()
