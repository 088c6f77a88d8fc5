// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/json_reader.h"
#include "scene/scene.h"

namespace gnomon::scene {

/// "materials" of a scene file: what it changes of the model's, by their names (docs/scene-files.md). Throws Error.
void change_materials(Scene&, const JsonReader& list);

} // namespace gnomon::scene
