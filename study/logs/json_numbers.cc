#include "study/logs/json_numbers.h"

#include <nlohmann/json.hpp>

namespace towbench::study::logs {
namespace {

using Json = nlohmann::json;
using Take = std::function<void(const std::string&, double)>;

constexpr int kDeepest = 8;
constexpr std::size_t kMostElements = 64;

std::string below(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

void walk(const Json& node, const std::string& path, int depth, const Take& take) {
  if (node.is_number()) {
    take(path, node.get<double>());
  } else if (node.is_boolean()) {
    take(path, node.get<bool>() ? 1.0 : 0.0);
  } else if (depth < kDeepest && node.is_object()) {
    for (const auto& [key, value] : node.items()) {
      walk(value, below(path, key), depth + 1, take);
    }
  } else if (depth < kDeepest && node.is_array()) {
    for (std::size_t i = 0; i < std::min(node.size(), kMostElements); ++i) {
      walk(node[i], below(path, std::to_string(i)), depth + 1, take);
    }
  }
}

}  // namespace

bool for_each_number(std::string_view json, const Take& take) {
  const Json root = Json::parse(json.begin(), json.end(), nullptr, false);
  if (root.is_discarded()) {
    return false;
  }
  walk(root, "", 0, take);
  return true;
}

}  // namespace towbench::study::logs
