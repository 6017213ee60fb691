// A small dense matrix, column by column: a product with a vector then runs down whole columns,
// which compilers turn into vector code without being told.
#pragma once

#include <array>
#include <cstddef>

namespace towbench::emulator {

template <std::size_t Size>
using Column = std::array<double, Size>;

template <std::size_t Size>
using SquareMatrix = std::array<Column<Size>, Size>;  // [column][row]

template <std::size_t Size>
[[nodiscard]] SquareMatrix<Size> identity() noexcept {
  SquareMatrix<Size> m{};
  for (std::size_t i = 0; i < Size; ++i) {
    m[i][i] = 1.0;
  }
  return m;
}

template <std::size_t Size>
[[nodiscard]] SquareMatrix<Size> product(const SquareMatrix<Size>& a,
                                         const SquareMatrix<Size>& b) noexcept {
  SquareMatrix<Size> c{};
  for (std::size_t column = 0; column < Size; ++column) {
    for (std::size_t k = 0; k < Size; ++k) {
      for (std::size_t row = 0; row < Size; ++row) {
        c[column][row] += a[k][row] * b[column][k];
      }
    }
  }
  return c;
}

// Largest sum of absolute values in a column.
template <std::size_t Size>
[[nodiscard]] double one_norm(const SquareMatrix<Size>& m) noexcept {
  double largest = 0;
  for (const auto& column : m) {
    double sum = 0;
    for (const double element : column) {
      sum += element < 0 ? -element : element;
    }
    largest = sum > largest ? sum : largest;
  }
  return largest;
}

// e^M by Taylor series on M / 2^s, |M / 2^s| <= 1/4, and s squarings. M is expected to be balanced
// (rows and columns of similar size), or digits are lost in the squarings.
template <std::size_t Size>
[[nodiscard]] SquareMatrix<Size> exponential_of(SquareMatrix<Size> m) noexcept {
  int squarings = 0;
  double scale = 1.0;
  while (one_norm(m) * scale > 0.25) {
    scale *= 0.5;
    ++squarings;
  }
  for (auto& column : m) {
    for (double& element : column) {
      element *= scale;
    }
  }
  constexpr int kTerms = 14;  // 0.25^15 / 15! < 1e-21
  SquareMatrix<Size> sum = identity<Size>();
  for (int n = kTerms; n >= 1; --n) {
    sum = product(m, sum);  // Horner: I + M/1 (I + M/2 (I + ...))
    for (std::size_t column = 0; column < Size; ++column) {
      for (std::size_t row = 0; row < Size; ++row) {
        sum[column][row] /= n;
      }
      sum[column][column] += 1.0;
    }
  }
  for (; squarings > 0; --squarings) {
    sum = product(sum, sum);
  }
  return sum;
}

}  // namespace towbench::emulator
