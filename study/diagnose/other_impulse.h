// What another axis adds to the momentum of one, over windows: the columns of OtherKey. Cosines and
// sines are taken about their means, so that the mass is that of the mean place.
#pragma once

#include <vector>

#include "study/diagnose/motion.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {

class OtherImpulse {
 public:
  // `joints`: both turn. All outlive this.
  OtherImpulse(const Run& run, const Motion& motion, const OtherAxis& other, bool joints);
  // Columns of the `n` samples from `from` on.
  void add_to(std::vector<double>& x, Eigen::Index from, Eigen::Index n) const;

 private:
  const Run& run_;
  const Motion& motion_;
  const OtherAxis& other_;
  OtherMotion other_motion_;
  bool joints_;
  double cos_q_ = 0;  // means
  double sin_q_ = 0;
  double cos_x_ = 0;
  double sin_x_ = 0;
};

[[nodiscard]] std::vector<OtherImpulse> others_of(const Run& run, const Motion& motion,
                                                  bool rotary);

}  // namespace towbench::study::diagnose
