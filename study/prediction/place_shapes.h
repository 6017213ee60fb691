// Force and dry friction by the load's place x: sums of a_k cos(k w), w = pi (x - x_min) / stroke;
// beyond the stroke that was seen, as at its end.
#pragma once

#include <array>
#include <limits>

#include "study/prediction/parameters.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {

class PlaceShapes {
 public:
  PlaceShapes(const Parameters& parameters, const Scene& scene);

  [[nodiscard]] bool any() const noexcept { return force_.any || viscous_.any || friction_.any; }
  [[nodiscard]] bool have_force() const noexcept { return force_.any || viscous_.any; }
  [[nodiscard]] bool have_friction() const noexcept { return friction_.any; }

  void go_to(double x_m) noexcept;
  // What resists there at that speed, and the level of dry friction.
  [[nodiscard]] double force_N(double v_m_per_s) const noexcept {
    return force_.at(cosine_) + v_m_per_s * viscous_.at(cosine_);
  }
  [[nodiscard]] double friction_N() const noexcept { return friction_.at(cosine_); }

 private:
  // A sum of cosines of multiples of w as a polynomial of cos w (Chebyshev's).
  struct Shape {
    Shape(const Parameters& parameters, Key first);
    [[nodiscard]] double at(double cosine) const noexcept;
    std::array<double, kShapes + 1> powers{};
    bool any = false;
  };

  double least_m_;
  double per_m_;
  Shape force_, viscous_, friction_;
  double cosine_ = 1;                                        // of w
  double anchor_ = std::numeric_limits<double>::infinity();  // an angle near w
  double anchor_cosine_ = 1;
  double anchor_sine_ = 0;
};

}  // namespace towbench::study::diagnose
