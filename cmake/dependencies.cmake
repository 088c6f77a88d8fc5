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

# For `gnomon view`, which is left out without them. Dear ImGui comes with no CMake target from Debian (libimgui-dev: headers in imgui/ and
# imgui/backends/, a library that holds the GLFW backend) and with imgui::imgui from vcpkg ([glfw-binding]).
find_package(glfw3 3.3 QUIET)
find_package(imgui CONFIG QUIET)
find_path(GNOMON_imgui_INCLUDE imgui.h PATH_SUFFIXES imgui)
find_path(GNOMON_imgui_glfw_INCLUDE imgui_impl_glfw.h PATH_SUFFIXES imgui/backends)
find_library(GNOMON_imgui_LIBRARY imgui)
find_library(GNOMON_stb_LIBRARY stb) # Debian's Dear ImGui takes its font rasteriser from there
if(glfw3_FOUND AND (TARGET imgui::imgui OR (GNOMON_imgui_INCLUDE AND GNOMON_imgui_glfw_INCLUDE AND GNOMON_imgui_LIBRARY)))
  add_library(gnomon_dep_window INTERFACE)
  add_library(gnomon::window ALIAS gnomon_dep_window)
  if(TARGET imgui::imgui)
    target_link_libraries(gnomon_dep_window INTERFACE imgui::imgui)
  else()
    target_include_directories(gnomon_dep_window SYSTEM INTERFACE ${GNOMON_imgui_INCLUDE} ${GNOMON_imgui_glfw_INCLUDE})
    target_link_libraries(gnomon_dep_window INTERFACE ${GNOMON_imgui_LIBRARY} $<$<BOOL:${GNOMON_stb_LIBRARY}>:${GNOMON_stb_LIBRARY}>)
  endif()
  target_link_libraries(gnomon_dep_window INTERFACE glfw)
else()
  message(STATUS "Building without `gnomon view`: GLFW 3.3 or Dear ImGui is not there (Debian: libglfw3-dev libimgui-dev)")
endif()
