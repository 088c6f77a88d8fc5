# SPDX-License-Identifier: Apache-2.0
# `cpack` in the build folder (./dev package): Debian packages in Debian's own partition, and one .tar.gz of all components.
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR Gnomon)
set(CPACK_PACKAGE_CONTACT "The Gnomon maintainers")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL library development)
if(TARGET gnomon)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(TARGET gnomon_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_PACKAGE_FILE_NAME gnomon-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})

set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
get_target_property(soversion gnomon_shared SOVERSION)

# debian_package(COMPONENT NAME SECTION "description" [DEPENDS ..] [RECOMMENDS ..])
macro(debian_package component name section description)
  cmake_parse_arguments(arg "" "DEPENDS;RECOMMENDS" "" ${ARGN})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${arg_DEPENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${arg_RECOMMENDS}")
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright COMPONENT ${component})
endmacro()
debian_package(library libgnomon${soversion} libs "Real-time shadows for renderers that use Vulkan: library
 Records the shadow of one light into the command buffer of a renderer.")
debian_package(development libgnomon-dev libdevel "Real-time shadows for renderers that use Vulkan: headers
 Headers for C and C++, the CMake package and the pkg-config file."
  DEPENDS "libgnomon${soversion} (= ${PROJECT_VERSION}), libvulkan-dev (>= 1.3)")
debian_package(program gnomon graphics "Laboratory for real-time shadows
 Renders, views, compares and measures shadow algorithms against ray-traced truth."
  DEPENDS "libvulkan1" RECOMMENDS "mesa-vulkan-drivers")
if(TARGET gnomon_python) # an extension is for one minor version of Python
  get_target_property(python gnomon_python GNOMON_PYTHON_VERSION)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" python ${python})
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  debian_package(python python3-gnomon python "Laboratory for real-time shadows: Python module
 Renders, traces the truth and compares, with NumPy arrays in and out."
    DEPENDS "python3 (>= ${python}), python3 (<< ${CMAKE_MATCH_1}.${next}), python3-numpy" RECOMMENDS "mesa-vulkan-drivers")
endif()
include(CPack)
