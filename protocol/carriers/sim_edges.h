// The machine's side of encoder channels on lines that the kernel simulates (gpio-sim), as
// sim_lines.h is for the digital lines.
#pragma once

#include <array>
#include <memory>

#include "protocol/carriers/gpio_edges.h"

namespace towbench::protocol {

class SimEdgeDriver final : public EdgeDriver {
 public:
  static CarrierResult<std::unique_ptr<SimEdgeDriver>> open(const EdgePlace& place);
  ~SimEdgeDriver() override;

  core::Status set(unsigned place, bool level) noexcept override;
  [[nodiscard]] bool has_index() const noexcept override { return has_index_; }

 private:
  explicit SimEdgeDriver(bool has_index) noexcept : has_index_(has_index) { pulls_.fill(-1); }

  std::array<int, kEncoderChannelsAndIndex> pulls_{};  // file descriptors
  bool has_index_;
};

}  // namespace towbench::protocol
