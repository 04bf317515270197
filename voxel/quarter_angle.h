// atan2 for the first quadrant, without branches, so that a compiler may work on several at once.
#pragma once

namespace interstice::voxel {

/// atan2(y, x) for x, y >= 0, not both 0; error about one unit in the last place. The ratio of the smaller to
/// the larger is brought below tan(pi/8), where atan(t) = t + t^3 p(t^2) with p the Chebyshev fit of degree
/// 10 to (atan(t)/t - 1)/t^2 on [0, tan^2(pi/8)], good to 3e-17 (fitted with 40 digits).
inline double quarter_angle(double y, double x) {
  constexpr double kEighth = 0.41421356237309504880;  // tan(pi/8)
  constexpr double kQuarterPi = 0.78539816339744830962, kHalfPi = 1.57079632679489661923;
  const bool steep = y > x;
  const double less = steep ? x : y, more = steep ? y : x;
  const bool turned = less > kEighth * more;
  const double t = (turned ? less - more : less) / (turned ? less + more : more), z = t * t;
  double p = -0.019176887119062258989;
  p = p * z + 0.039231658295587191303;
  p = p * z - 0.050854497379402598613;
  p = p * z + 0.058581489128022098816;
  p = p * z - 0.066645114473819480001;
  p = p * z + 0.076921831908260865637;
  p = p * z - 0.090909045781239018905;
  p = p * z + 0.11111111015256361727;
  p = p * z - 0.14285714284666542922;
  p = p * z + 0.19999999999995520678;
  p = p * z - 0.3333333333333333016;
  const double angle = (turned ? kQuarterPi : 0.0) + (t + t * z * p);
  return steep ? kHalfPi - angle : angle;
}

}  // namespace interstice::voxel
