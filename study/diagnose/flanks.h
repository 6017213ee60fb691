// Which flank of a play carries, as the chain's force says, and how the gap between is crossed.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace towbench::harness::diagnose {

struct Flanks {
  Eigen::VectorXd side;  // +1 or -1; between them smoothly from one to the other
  struct Gap {
    Eigen::Index from = 0;  // the last sample on one flank
    Eigen::Index to = 0;    // the first on the other
  };
  std::vector<Gap> gaps;
};

[[nodiscard]] Flanks find_flanks(const Eigen::VectorXd& chain_N);

// The load's way, known on the flanks. Inside a gap no force shows it; it left the one with its
// place and speed and met the other with them, and the cubic through the four (Hermite) is what a
// force that changes evenly makes of a free load. Without play there is no gap.
[[nodiscard]] Eigen::VectorXd crossed(const Flanks& flanks, Eigen::VectorXd load_m, double play_m);

}  // namespace towbench::harness::diagnose
