#include "study/prediction/other_axes.h"

#include <cmath>

namespace towbench::study::diagnose {
namespace {

// The keys of one of them.
class Keys {
 public:
  Keys(const Parameters& p, int other) : p_(p), other_(other) {}
  double operator[](OtherKey key) const { return p_[key_of(other_, key)]; }
  [[nodiscard]] bool any() const {
    for (int key = 0; key < kOtherKeys; ++key) {
      if ((*this)[static_cast<OtherKey>(key)] != 0) return true;
    }
    return false;
  }

 private:
  const Parameters& p_;
  int other_;
};

void add(const Keys& of, double x, double q, double w, double a, OfOthers& sum) {
  const double cos_q = std::cos(q);
  const double sin_q = std::sin(q);
  const double cos_x = std::cos(x);
  const double sin_x = std::sin(x);
  sum.force_N += of[OtherKey::kMass] * a + of[OtherKey::kViscous] * w +
                 of[OtherKey::kCosine] * (cos_q * a - sin_q * w * w) +
                 of[OtherKey::kSine] * (sin_q * a + cos_q * w * w) +
                 of[OtherKey::kOwnCosine] * (cos_x * a + sin_x * w * w) +
                 of[OtherKey::kOwnSine] * (sin_x * a - cos_x * w * w) +
                 of[OtherKey::kWeightCosine] * (cos_x * cos_q - sin_x * sin_q) +
                 of[OtherKey::kWeightSine] * (sin_x * cos_q + cos_x * sin_q);
  sum.mass_kg += of[OtherKey::kInertiaCosine] * cos_q + of[OtherKey::kInertiaSine] * sin_q;
  sum.mass_kg_per_s +=
      (of[OtherKey::kInertiaSine] * cos_q - of[OtherKey::kInertiaCosine] * sin_q) * w;
}

}  // namespace

bool has_others(const Parameters& p) {
  for (int other = 0; other < kOthers; ++other) {
    if (Keys(p, other).any()) return true;
  }
  return false;
}

OfOthers of_others(const Parameters& p, const Scene& scene, Eigen::Index k, double x) {
  OfOthers sum;
  for (std::size_t i = 0; i < scene.others.size(); ++i) {
    const Keys of(p, static_cast<int>(i));
    if (!of.any()) continue;
    const OtherMotion& m = scene.others[i];
    add(of, x, scene.run->others[i].position_m[k], m.m_per_s[k], m.m_per_s2[k], sum);
  }
  return sum;
}

}  // namespace towbench::study::diagnose
