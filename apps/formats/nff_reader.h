// Reads NFF, Haines' neutral file format (SPD 3.14, NFF.TXT): strict about what it finds, lenient about layout.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "apps/formats/resolution.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Polygons with more vertices than this count as an error in the file.
inline constexpr int polygon_vertices_max = 65'535;
/// The matt colour of objects without a material, as in mesh files.
inline constexpr core::Vec3d plain_color{0.6, 0.6, 0.6};
/// Pixels along a side.
inline constexpr int resolution_max = 65'535;

/// Reads all entities (v b l f c s p pp) as a stream of blank-separated tokens with `#` comments, number for number as the file
/// says them; a byte order mark before them is skipped. Objects before the first `f` are matt of plain_color; surplus numbers at
/// the end of an `l` or `f` line are ignored; no background is black, as the format has it. Degenerate objects are kept: building
/// the database drops and counts them. `name` becomes the scene's. Throws core::InputError "NAME:LINE: what was found, what was
/// expected, what to do" at the first mistake: unknown keyword; missing, malformed or not finite number; fewer than 3 or too many
/// vertices; colours, Ks or T outside 0..1; negative Kd, Shine or light; a transmitter without an index of refraction above 0; a
/// cone with radii of different sign; a second `v` or `b`; a view that has no direction, no picture, more than `pixels_max`
/// pixels, points beyond view_coordinate_max, or an angle outside (0, 180); an empty stream; no view at all.
core::Scene read_nff(std::istream& input, const std::string& name, std::int64_t pixels_max = picture_pixels_max);

/// Reads a file; also throws for anything but a file or a pipe (apps/frontend/system/text_input.h). `progress`, if any, is called
/// now and then with the bytes read and the bytes of the file, unless that is a pipe or the like.
core::Scene read_nff_file(const std::string& path, std::int64_t pixels_max = picture_pixels_max,
                          const std::function<void(std::uint64_t, std::uint64_t)>& progress = {});

}  // namespace dmpc::apps
