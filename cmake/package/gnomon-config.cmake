# SPDX-License-Identifier: Apache-2.0
# find_package(gnomon 0.2 CONFIG REQUIRED) gives gnomon::gnomon: the library and its headers, which include Vulkan's. The host loads
# Vulkan as it likes: no loader is linked.
if(NOT TARGET Vulkan::Headers)
  find_package(VulkanHeaders CONFIG QUIET)
endif()
if(NOT TARGET Vulkan::Headers)
  include(CMakeFindDependencyMacro)
  find_dependency(Vulkan 1.3)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/gnomon-targets.cmake)
set_property(TARGET gnomon::gnomon APPEND PROPERTY INTERFACE_LINK_LIBRARIES Vulkan::Headers)
