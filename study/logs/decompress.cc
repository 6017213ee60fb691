#include "study/logs/decompress.h"

#include <memory>

#include <lz4frame.h>
#include <zstd.h>

namespace towbench::study::logs {
namespace {

bool from_lz4(std::string_view data, std::string& out) {
  using Context =
      std::unique_ptr<LZ4F_dctx, decltype([](LZ4F_dctx* c) { LZ4F_freeDecompressionContext(c); })>;
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return false;
  }
  const Context context(made);
  std::size_t filled = 0;
  std::size_t hint = 1;
  while (hint != 0 && !data.empty()) {
    std::size_t room = out.size() - filled;
    std::size_t used = data.size();
    hint = LZ4F_decompress(made, out.data() + filled, &room, data.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0 || (room == 0 && used == 0)) {
      return false;
    }
    filled += room;
    data.remove_prefix(used);
  }
  return hint == 0 && filled == out.size();
}

}  // namespace

std::optional<std::string> decompressed(std::string_view method, std::string_view data,
                                        std::size_t size) {
  if (method.empty()) {
    return data.size() == size ? std::optional(std::string(data)) : std::nullopt;
  }
  std::string out(size, '\0');
  bool whole = false;
  if (method == "lz4") {
    whole = from_lz4(data, out);
  } else if (method == "zstd") {
    whole = ZSTD_decompress(out.data(), out.size(), data.data(), data.size()) == size;
  }
  return whole ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace towbench::study::logs
