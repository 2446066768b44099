// The elementary functions that may affect a picture. They use only + - * / sqrt and fma, so every x86-64 processor computes the
// same bits, which no libm guarantees.
#pragma once

namespace dmpc::core {

/// Sine and cosine of an angle in radians, |radians| <= 1e6. Absolute error below 2.3e-16, relative error below 4e-16.
double sin_radians(double radians);
double cos_radians(double radians);
/// Tangent of an angle in radians, |radians| <= 1e6: relative error below 1e-15.
double tan_radians(double radians);

/// Sine and cosine of an angle in degrees, |degrees| <= 1e6, with the same errors; exact where the value is 0, 1/2 or 1 in
/// magnitude (the multiples of 30 and 90 degrees that have such a value).
double sin_degrees(double degrees);
double cos_degrees(double degrees);
/// Relative error below 1e-15; requires an angle whose cosine is not 0.
double tan_degrees(double degrees);

/// The angle from the positive x-axis to the point (x, y) in radians, from -pi to pi: absolute error below 5e-16. It is 0 if both
/// are 0; neither may be infinite or NaN.
double angle_of(double y, double x);

/// e to the power x, for any x: relative error below 4e-16 where the result is a normal number; 0 below -745.2, infinity above
/// 709.79.
double exponential(double x);

/// The natural logarithm: relative error below 7e-16. Minus infinity at 0, NaN below 0; x must be finite.
double natural_log(double x);

/// base ^ exponent for 0 <= base <= 1 and exponent >= 0, used for the highlight of B. T. Phong, "Illumination for Computer
/// Generated Pictures" (1975). The result lies in [0, 1] with an absolute error below 6e-16; 0 ^ 0 = 1. A base outside [0, 1] is
/// clamped.
double pow_unit(double base, double exponent);

/// The number with 6 significant decimal digits nearest to `value`, ties to even: what strtod reads from printf's %g. Keeps the
/// sign of zero; returns infinities and NaNs unchanged.
double round_to_6_digits(double value);

}  // namespace dmpc::core
