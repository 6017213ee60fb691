// What other axes of the same machine do to one, by the equations of rigid bodies: q is the other's
// place, w its speed, x and v of this axis.
#pragma once

#include "study/prediction/parameters.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {

// Of each other axis. Between joints: cosine and sine of an angle.
enum class OtherKey : std::uint8_t {
  kMass,     // kg: d/dt(m w)
  kViscous,  // N s/m: by its speed
  kCosine,   // kg: d/dt((c cos q + s sin q) w)
  kSine,
  kOwnCosine,  // kg: c (cos x w' + sin x w^2) + s (sin x w' - cos x w^2)
  kOwnSine,
  kInertiaCosine,  // kg: d/dt((c cos q + s sin q) v)
  kInertiaSine,
  kWeightCosine,  // N: c cos(x + q) + s sin(x + q)
  kWeightSine,
  kCount
};
static_assert(static_cast<int>(OtherKey::kCount) == kOtherKeys);

[[nodiscard]] constexpr Key key_of(int other, OtherKey key) noexcept {
  return next(Key::kOther, other * kOtherKeys + static_cast<int>(key));
}

struct OfOthers {
  double force_N = 0;        // that the drive must make besides
  double mass_kg = 0;        // beside this axis's own
  double mass_kg_per_s = 0;  // its rate
};

[[nodiscard]] bool has_others(const Parameters& p);
// At sample `k`, this axis at `x`.
[[nodiscard]] OfOthers of_others(const Parameters& p, const Scene& scene, Eigen::Index k, double x);

}  // namespace towbench::study::diagnose
