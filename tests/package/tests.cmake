# SPDX-License-Identifier: Apache-2.0
# What is installed and packaged, as its users meet it: moved to a prefix of its own, with no other path of this tree known.
set(package_folder ${CMAKE_BINARY_DIR}/package_tests)
set(prefix ${package_folder}/prefix)
set(consumer_options "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE};-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER};-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER};-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}")
string(REPLACE ";" "\\;" consumer_options "${consumer_options}")

# package_test(NAME [VARIABLE=VALUE..]): NAME.cmake
function(package_test name)
  set(definitions)
  foreach(definition SOURCE=${CMAKE_SOURCE_DIR} BUILD=${CMAKE_BINARY_DIR} PREFIX=${prefix} FOLDER=${package_folder}/${name} VERSION=${PROJECT_VERSION}
      SOVERSION=${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} GENERATOR=${CMAKE_GENERATOR} CC=${CMAKE_C_COMPILER} NM=${CMAKE_NM} OBJDUMP=${CMAKE_OBJDUMP} ${ARGN})
    list(APPEND definitions "-D${definition}")
  endforeach()
  add_test(NAME package.${name} COMMAND ${CMAKE_COMMAND} ${definitions} "-DOPTIONS=${consumer_options}" -P ${CMAKE_CURRENT_SOURCE_DIR}/package/${name}.cmake)
  set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED prefix TIMEOUT 900 SKIP_REGULAR_EXPRESSION "^skipped: "
    ENVIRONMENT "CMAKE_CXX_COMPILER_LAUNCHER=${GNOMON_CCACHE}")
endfunction()

package_test(install FIRST=${package_folder}/first)
set_tests_properties(package.install PROPERTIES FIXTURES_REQUIRED "" FIXTURES_SETUP prefix)
package_test(headers VULKAN=${Vulkan_INCLUDE_DIR})
package_test(library)
package_test(consumer)
package_test(debian CPACK=${CMAKE_CPACK_COMMAND} PROGRAM=$<TARGET_EXISTS:gnomon> PYTHON=$<TARGET_EXISTS:gnomon_python>)

# The example of an engine, built against the prefix and run.
package_test(host_engine)
set_tests_properties(package.host_engine PROPERTIES FIXTURES_SETUP host_engine)
gnomon_program(gnomon_package_tests SOURCES package/host_engine_test.cpp DEPENDS GTest::gtest_main)
target_compile_definitions(gnomon_package_tests PRIVATE GNOMON_SOURCE="${CMAKE_SOURCE_DIR}" HOST_ENGINE="${package_folder}/host_engine/build/host_engine")
gtest_discover_tests(gnomon_package_tests DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES PROPERTIES LABELS package FIXTURES_REQUIRED host_engine)
