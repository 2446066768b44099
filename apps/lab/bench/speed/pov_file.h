// Our scenes as POV-Ray 3.7 reads them.
#pragma once

#include <string>
#include <string_view>

#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/bench/speed/plain_stage.h"

namespace dmpc::apps {

/// A scene file with all that NFF can say: the camera, lights, background, materials, triangles, flat and smooth, spheres and
/// cones, in the database's coordinates. Surfaces let no light through to others, as ours do not, whatever they transmit: those
/// that do stand there twice, once without a shadow, and once for that alone. Left out is what NFF cannot say: highlights have no
/// colour of their own, nothing shines by itself, and spheres and cones of which the inside alone is visible are whole.
std::string pov_of(const PlainStage& stage);

/// The pixels of a binary PPM file of 16 bits, taken as linear: 65535 is 1. Throws core::InputError for anything else.
PlainPicture picture_in_ppm(std::string_view bytes);

}  // namespace dmpc::apps
