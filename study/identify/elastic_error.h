// How far the carriage is behind its motor, from encoder and camera alone (thesis 9.3.1: "requires
// the use of external sensors"). Of frames c_k that arrive at t_k and the motor's position m(t):
//
//   m(t_k - d) - c_k = o + a(t_k - d) / w_h^2 + x_f s(v(t_k - d)) + noise
//
// d delay, o offset of the two frames, w_h held-motor frequency of the transmission ((J_l a + C_l
// s)/k, as control_law.h), x_f stretch by friction, s = v/(|v| + v_0). All four by least squares:
// o, 1/w_h^2 and x_f linearly for each d, d where the residual is least. v and a are those of the
// reference, smooth and known; frames are used where it moves. At one constant speed d and x_f are
// the same thing: refused, as their intervals say.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace towbench::study::identify {

// Of one axis; the motor's columns at ascending times, the camera's likewise.
struct ElasticInput {
  std::vector<double> time_s;
  std::vector<double> motor_m;
  std::vector<double> speed_m_per_s;  // of the reference
  std::vector<double> frame_s;        // when it arrived
  std::vector<double> seen_m;
  double smoothing_m_per_s = 1e-3;  // v_0
  double longest_delay_s = 0.5;
};

struct Within95 {
  double value = 0;
  double half_width = 0;
};

struct ElasticError {
  std::string trouble;  // empty: found
  std::size_t frames = 0;
  Within95 delay_s;
  Within95 offset_m;
  Within95 per_acceleration_s2;  // 1 / w_h^2
  Within95 friction_stretch_m;   // x_f
  double residual_rms_m = 0;     // noise, quantisation and what the model lacks
  double rms_m = 0;              // of the modelled stretch: what swings is in the residual
  double peak_m = 0;             // of the same
  // At each frame used: when it was exposed, and the stretch as seen, offset taken off.
  std::vector<double> exposed_s;
  std::vector<double> stretch_m;
};

[[nodiscard]] ElasticError elastic_error(const ElasticInput& input);

}  // namespace towbench::study::identify
