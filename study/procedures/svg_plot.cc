#include "study/procedures/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/report/html.h"

namespace towbench::study::procedures {
namespace {

using harness::report::escaped;

constexpr double kWidth = 760;
constexpr double kHeight = 340;
constexpr double kLeft = 78;
constexpr double kRight = 16;
constexpr double kTop = 30;
constexpr double kBottom = 48;
// Okabe and Ito's colours: told apart by everybody.
constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#56b4e9", "#e69f00", "#333333"};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] bool empty() const { return !(low <= high); }
  void widen() {
    const double room = high > low ? 0.04 * (high - low) : std::max(1e-12, std::fabs(high) * 0.1);
    low -= room;
    high += room;
  }
};

double tick_step(const Range& range) {
  const double rough = (range.high - range.low) / 6;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double each : {1.0, 2.0, 5.0}) {
    if (each * power >= rough) {
      return each * power;
    }
  }
  return 10 * power;
}

class Plot {
 public:
  explicit Plot(const Figure& figure) : figure_(figure) {
    for (const auto& curve : figure.curves) {
      for (std::size_t i = 0; i < curve.x.size() && i < curve.y.size(); ++i) {
        if (std::isfinite(curve.y[i])) {
          x_.take(curve.x[i]);
          y_.take(curve.y[i]);
          if (curve.low.size() == curve.y.size()) {
            y_.take(curve.low[i]);
            y_.take(curve.high[i]);
          }
        }
      }
    }
  }

  std::string text() {
    out_ = fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<title>{}</title>\n",
        kWidth, kHeight, escaped(figure_.title));
    out_ += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    if (x_.empty() || y_.empty()) {
      out_ += "<text x=\"20\" y=\"40\">no data</text>\n</svg>\n";
      return out_;
    }
    x_.widen();
    y_.widen();
    grid();
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) {
      draw(figure_.curves[i], kColours.at(i % kColours.size()));
    }
    legend();
    out_ += "</svg>\n";
    return out_;
  }

 private:
  [[nodiscard]] double px(double x) const {
    return kLeft + (x - x_.low) / (x_.high - x_.low) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double py(double y) const {
    return kHeight - kBottom - (y - y_.low) / (y_.high - y_.low) * (kHeight - kTop - kBottom);
  }

  void grid() {
    const double dx = tick_step(x_);
    for (double x = std::ceil(x_.low / dx) * dx; x <= x_.high; x += dx) {
      out_ += fmt::format(
          "<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#dddddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:.6g}</text>\n",
          px(x), kTop, kHeight - kBottom, kHeight - kBottom + 16, std::fabs(x) < dx / 1e6 ? 0 : x);
    }
    const double dy = tick_step(y_);
    for (double y = std::ceil(y_.low / dy) * dy; y <= y_.high; y += dy) {
      out_ += fmt::format(
          "<path d=\"M{1} {0:.1f}H{2}\" stroke=\"#dddddd\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.6g}</text>\n",
          py(y), kLeft, kWidth - kRight, kLeft - 6, py(y) + 4, std::fabs(y) < dy / 1e6 ? 0 : y);
    }
    out_ += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                        0.5 * (kLeft + kWidth - kRight), kHeight - 10, escaped(figure_.x_label));
    out_ += fmt::format(
        "<text transform=\"translate(14 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        0.5 * (kTop + kHeight - kBottom), escaped(figure_.y_label));
  }

  void draw(const Curve& curve, const char* colour) {
    const std::size_t n = std::min(curve.x.size(), curve.y.size());
    if (curve.low.size() == n && curve.high.size() == n) {
      for (std::size_t i = 0; i < n; ++i) {
        if (std::isfinite(curve.y[i]) && std::isfinite(curve.low[i])) {
          out_ += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"{}\"/>\n", px(curve.x[i]),
                              py(curve.low[i]), py(curve.high[i]), colour);
        }
      }
    }
    if (curve.mark == Mark::kDots) {
      for (std::size_t i = 0; i < n; ++i) {
        if (std::isfinite(curve.y[i])) {
          out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"{}\"/>\n",
                              px(curve.x[i]), py(curve.y[i]), colour);
        }
      }
      return;
    }
    std::string path;
    bool pen_down = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(curve.y[i])) {
        pen_down = false;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', px(curve.x[i]), py(curve.y[i]));
      pen_down = true;
    }
    out_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"/>\n", path,
                        colour);
  }

  void legend() {
    double x = kLeft;
    for (std::size_t i = 0; i < figure_.curves.size(); ++i) {
      const auto& name = figure_.curves[i].name;
      out_ += fmt::format(
          "<rect x=\"{0:.0f}\" y=\"10\" width=\"12\" height=\"10\" fill=\"{1}\"/>"
          "<text x=\"{2:.0f}\" y=\"19\">{3}</text>\n",
          x, kColours.at(i % kColours.size()), x + 17, escaped(name));
      x += 17 + 7.0 * static_cast<double>(name.size()) + 18;
    }
  }

  const Figure& figure_;
  Range x_;
  Range y_;
  std::string out_;
};

}  // namespace

std::string svg_plot(const Figure& figure) {
  return Plot(figure).text();
}

}  // namespace towbench::study::procedures
