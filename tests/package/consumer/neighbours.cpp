// SPDX-License-Identifier: Apache-2.0
// An engine that has copies of its own of what Gnomon is made of, under the same names and visible to every library of the process.
// None of Gnomon's calls may end here, and nothing here may be overwritten.
#define VK_NO_PROTOTYPES
#include <gnomon/gnomon.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#define NEIGHBOUR __attribute__((visibility("default"), used))
#define POISON(name)                                                                                                                       \
    NEIGHBOUR void name()                                                                                                                  \
    {                                                                                                                                      \
        std::fputs("Gnomon called the engine's " #name "\n", stderr);                                                                      \
        std::abort();                                                                                                                      \
    }

extern "C" {
// volk keeps Vulkan's functions in variables; an engine that links the loader has functions of these names
POISON(vkCreateImage)
POISON(vkCmdPipelineBarrier2)
POISON(vkGetPhysicalDeviceProperties)
NEIGHBOUR void* vkCreateDevice = &vkCreateDevice;
POISON(volkInitialize)
POISON(volkLoadDevice)
POISON(stbi_load_from_memory)
POISON(stbi_failure_reason)
POISON(stbi_write_png)
}

int main()
{
    gnomon_technique technique;
    for (uint32_t i = 0; i < gnomon_technique_count(); ++i)
        if (gnomon_technique_get(i, &technique) != GNOMON_SUCCESS) return 1;
    if (gnomon_technique_get(~0u, &technique) != GNOMON_ERROR_ARGUMENT) return 2;
    if (!std::strstr(gnomon_error_message(), "4294967295")) return 3; // formatted
    gnomon_device device = nullptr;
    gnomon_device_info info{};
    info.version = GNOMON_VERSION;
    if (gnomon_device_create(&info, &device) != GNOMON_ERROR_ARGUMENT || device) return 4;
    return vkCreateDevice == &vkCreateDevice ? 0 : 5;
}
