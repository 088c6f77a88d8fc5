// SPDX-License-Identifier: Apache-2.0
#include <gnomon/gnomon.hpp>

#include <cstdio>
#include <cstring>

int main()
{
    for (const gnomon_technique& t : gnomon::techniques()) std::printf("%s\n", t.id);
    try {
        const gnomon::Device device{gnomon_device_info{}}; // no handles
    } catch (const gnomon::Error& e) {
        std::printf("%s\n", e.what());
        return e.result == GNOMON_ERROR_ARGUMENT && std::strlen(e.what()) > 10 ? 0 : 1;
    }
    return 2;
}
