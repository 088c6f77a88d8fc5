# SPDX-License-Identifier: Apache-2.0
"""How wrong three techniques are on one scene, and what they cost."""
import gnomon

scene = gnomon.load("contact")
truth = gnomon.truth(scene, light="sun,angle=0", size=(480, 270))
for technique in ("shadow_map:map_size=1024", "pcf:kernel=5", "ray_traced"):
    image = gnomon.render(scene, technique, light="sun,angle=0", size=(480, 270), repeats=3)
    errors = gnomon.compare(image, truth)
    print(f"{technique:25} {errors['wrong_pixels']:.5f} wrong, {image.technique_ms:6.1f} ms")
