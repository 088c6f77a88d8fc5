# SPDX-License-Identifier: Apache-2.0
# `cmake --install build --prefix P` by components: library (what a program that uses Gnomon needs to run), development (headers, CMake
# package, pkg-config) and program. All of it may be moved: nothing holds the prefix. The bundle's components are apart (bundle.cmake).
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
  # GNUInstallDirs does so for the prefix /usr alone, and the .deb files are made from the same build as every other installation.
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Libraries, below the prefix")
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(gnomon_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
target_include_directories(gnomon_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS gnomon_shared EXPORT gnomon
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library)
install(DIRECTORY include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(EXPORT gnomon NAMESPACE gnomon:: FILE gnomon-targets.cmake DESTINATION ${gnomon_cmake_dir} COMPONENT development)

# Semantic versions: below 1.0 every minor version may break its users, above it only major ones; the soname says the same.
set(gnomon_compatibility SameMajorVersion)
if(PROJECT_VERSION VERSION_LESS 1)
  set(gnomon_compatibility SameMinorVersion)
endif()
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/gnomon-config-version.cmake COMPATIBILITY ${gnomon_compatibility})
file(RELATIVE_PATH gnomon_up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" gnomon_up ${gnomon_up})
configure_file(cmake/package/gnomon.pc.in ${CMAKE_BINARY_DIR}/package/gnomon.pc @ONLY)
install(FILES cmake/package/gnomon-config.cmake ${CMAKE_BINARY_DIR}/package/gnomon-config-version.cmake
  DESTINATION ${gnomon_cmake_dir} COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/package/gnomon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(TARGET gnomon)
  install(TARGETS gnomon RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # The search path is the bundle's: an installed program takes the system's libraries.
  install(CODE "file(RPATH_REMOVE FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/gnomon\")" COMPONENT program)
endif()
