// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "commands.h"

#ifdef GNOMON_VIEW
#include "apps/view/view.h"
#endif

namespace gnomon::cli {

#ifdef GNOMON_VIEW
int view(const View& options)
{
    return view::run({.stage = stage_options(options.picture),
        .technique = options.technique,
        .parameters = options.parameters,
        .against = options.against,
        .device = options.common.device,
        .validation = options.common.validation,
        .exposure = options.exposure,
        .ambient = options.ambient,
        .state = options.state,
        .measure = options.measure,
        .json = options.common.json});
}
#else
int view(const View&)
{
    base::fail(
        "this gnomon was built without its window; install GLFW and Dear ImGui (Debian: apt-get install libglfw3-dev libimgui-dev) and "
        "build it again, or make pictures with `gnomon render`");
}
#endif

} // namespace gnomon::cli
