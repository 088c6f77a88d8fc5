/* SPDX-License-Identifier: Apache-2.0 */
#include <gnomon/gnomon.h>

#include <stdio.h>
#include <string.h>

int main(void)
{
    gnomon_technique technique;
    const uint32_t count = gnomon_technique_count();
    if (gnomon_version() != GNOMON_VERSION || count == 0) return 1;
    for (uint32_t i = 0; i < count; ++i)
        if (gnomon_technique_get(i, &technique) != GNOMON_SUCCESS || strlen(technique.id) == 0) return 2;
    if (gnomon_technique_get(count, &technique) != GNOMON_ERROR_ARGUMENT) return 3;
    printf("%u techniques; beyond them: %s\n", count, gnomon_error_message());
    return strlen(gnomon_error_message()) == 0 ? 4 : 0;
}
