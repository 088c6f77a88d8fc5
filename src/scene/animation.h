// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace gnomon::scene {

/// Seconds after which the longest animation of a scene, by name or file as for `load`, begins again; 0 where nothing moves. Throws Error
/// where the file cannot be read.
double animation_seconds(const std::string& name_or_file);

} // namespace gnomon::scene
