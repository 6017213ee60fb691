// A value for each axis of a machine, in a row of which many are kept: the two of a plane in
// place, those of further axes on the heap and only where there are some.
#pragma once

#include <array>
#include <memory>

#include "core/axis.h"

namespace towbench::harness {

template <typename T>
class KeptAxes {
 public:
  KeptAxes() = default;
  explicit KeptAxes(const core::PerPlanarAxis<T>& planar) : planar_(planar) {}
  // `has_further`: whether those beyond the plane are kept as well.
  KeptAxes(const core::PerAxis<T>& axes, bool has_further) {
    for (const auto axis : core::kAllAxes) {
      if (core::is_planar(axis) || has_further) {
        (*this)[axis] = axes[axis];
      }
    }
  }
  KeptAxes(const KeptAxes& other) : planar_(other.planar_) { keep(other); }
  KeptAxes(KeptAxes&&) noexcept = default;
  KeptAxes& operator=(const KeptAxes& other) {
    if (this != &other) {
      planar_ = other.planar_;
      further_.reset();
      keep(other);
    }
    return *this;
  }
  KeptAxes& operator=(KeptAxes&&) noexcept = default;
  ~KeptAxes() = default;

  [[nodiscard]] const T& operator[](core::Axis axis) const noexcept {
    static const T kNone{};
    if (core::is_planar(axis)) {
      return planar_[axis];
    }
    return further_ ? (*further_)[place_of(axis)] : kNone;
  }
  [[nodiscard]] T& operator[](core::Axis axis) {
    if (core::is_planar(axis)) {
      return planar_[axis];
    }
    if (!further_) {
      further_ = std::make_unique<Further>();
    }
    return (*further_)[place_of(axis)];
  }

 private:
  using Further = std::array<T, core::kFurtherAxes.size()>;

  [[nodiscard]] static std::size_t place_of(core::Axis axis) noexcept {
    return core::index_of(axis) - core::kPlanarAxes.size();
  }
  void keep(const KeptAxes& other) {
    if (other.further_) {
      further_ = std::make_unique<Further>(*other.further_);
    }
  }

  core::PerPlanarAxis<T> planar_;
  std::unique_ptr<Further> further_;
};

}  // namespace towbench::harness
