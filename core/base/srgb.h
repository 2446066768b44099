// The sRGB curve (IEC 61966-2-1), from arithmetic alone, so that an 8-bit picture is the same on every machine.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// Linear light of an encoded value; both 0 to 1. x/12.92 up to 0.04045, ((x + 0.055) / 1.055)^2.4 above. Outside it is clamped.
double linear_from_srgb(double encoded);

/// The byte whose encoded value lies nearest to that of `linear`, clamped to 0..255; NaN gives 0. Exact: a comparison with the
/// linear values half-way between neighbouring bytes.
std::uint8_t srgb_byte(float linear);

}  // namespace dmpc::core
