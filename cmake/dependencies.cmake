# SPDX-License-Identifier: Apache-2.0
# Every dependency is a package (Debian 12, or vcpkg.json elsewhere). Where a package brings no CMake target, one is made here.
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(glm REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Vulkan 1.3.239 REQUIRED)
find_package(Threads REQUIRED)
find_program(GNOMON_GLSLC glslc REQUIRED)

function(gnomon_imported name header)
  cmake_parse_arguments(arg "" "" "LIBRARIES;SUFFIXES;DEPENDS" ${ARGN})
  add_library(gnomon_dep_${name} INTERFACE)
  add_library(gnomon::${name} ALIAS gnomon_dep_${name})
  find_path(GNOMON_${name}_INCLUDE ${header} PATH_SUFFIXES ${arg_SUFFIXES} REQUIRED)
  target_include_directories(gnomon_dep_${name} SYSTEM INTERFACE ${GNOMON_${name}_INCLUDE})
  foreach(library ${arg_LIBRARIES})
    find_library(GNOMON_${library}_LIBRARY ${library} REQUIRED)
    target_link_libraries(gnomon_dep_${name} INTERFACE ${GNOMON_${library}_LIBRARY})
  endforeach()
  target_link_libraries(gnomon_dep_${name} INTERFACE ${arg_DEPENDS})
endfunction()

gnomon_imported(stb stb_image.h SUFFIXES stb) # headers only: the implementation is compiled once, in base
gnomon_imported(tinyexr tinyexr.h LIBRARIES tinyexr)
gnomon_imported(volk volk.h DEPENDS Vulkan::Headers ${CMAKE_DL_LIBS}) # header only: loads Vulkan at run time, links nothing
gnomon_imported(spirv_cross spirv_cross_c.h SUFFIXES spirv_cross LIBRARIES spirv-cross-c-shared)
