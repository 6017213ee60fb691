#include "study/logs/mcap_records.h"

#include <fstream>

#include <boost/crc.hpp>
#include <fmt/format.h>

#include "study/logs/decompress.h"
#include "study/logs/mcap_bytes.h"

namespace towbench::study::logs {
namespace {

enum class Op : std::uint8_t { kChannel = 0x04, kMessage = 0x05, kChunk = 0x06, kDataEnd = 0x0F };

// Writers make chunks of some megabytes. A length beyond this is damage.
constexpr std::uint64_t kLargestRecord_bytes = 512U << 20U;
constexpr std::size_t kRecordHead_bytes = 9;

class McapReader {
 public:
  McapReader(const std::filesystem::path& path, const McapVisitor& visit)
      : file_(path, std::ios::binary), visit_(visit) {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(file_.tellg());
    file_.seekg(static_cast<std::streamoff>(kMcapMagic.size()));
  }

  McapEnd read() {
    at_ = kMcapMagic.size();
    while (!stopped_ && next_record()) {
    }
    return end_;
  }

 private:
  bool damaged(const std::string& what) {
    end_.damage = fmt::format("byte {}: {}", at_, what);
    return false;
  }

  // False at the end of what can be read.
  bool next_record() {
    std::string head(kRecordHead_bytes, '\0');
    if (!file_.read(head.data(), static_cast<std::streamsize>(head.size()))) {
      return false;
    }
    McapBytes fields(head);
    const auto op = static_cast<Op>(fields.number<std::uint8_t>());
    const auto length = fields.number<std::uint64_t>();
    if (op == Op::kDataEnd) {
      end_.ends_whole = true;
      return false;
    }
    if (length > size_ - at_ - kRecordHead_bytes) {
      return damaged(fmt::format("a record of {} bytes, and the file ends before", length));
    }
    if (op == Op::kChannel || op == Op::kMessage || op == Op::kChunk) {
      if (length > kLargestRecord_bytes) {
        return damaged(fmt::format("a record of {} bytes", length));
      }
      body_.resize(length);
      file_.read(body_.data(), static_cast<std::streamsize>(length));
      if (!(op == Op::kChunk ? open_chunk(body_) : take(op, body_))) {
        return false;
      }
    } else {
      file_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    }
    at_ += kRecordHead_bytes + length;
    return true;
  }

  bool open_chunk(std::string_view body) {
    McapBytes fields(body);
    fields.take(2 * sizeof(std::uint64_t));  // first and last time
    const auto size = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    const auto method = fields.text();
    const auto data = fields.take(fields.number<std::uint64_t>());
    if (!fields.ok() || size > kLargestRecord_bytes) {
      return damaged("a chunk whose head is damaged");
    }
    const auto records = decompressed(method, data, size);
    if (!records) {
      return damaged(fmt::format("a chunk ({}) that cannot be decompressed",
                                 method.empty() ? "plain" : method));
    }
    if (boost::crc_32_type sum; crc != 0) {
      sum.process_bytes(records->data(), records->size());
      if (sum.checksum() != crc) {
        return damaged("a chunk whose checksum is wrong");
      }
    }
    McapBytes inside(*records);
    while (!stopped_ && !inside.left().empty()) {
      const auto op = static_cast<Op>(inside.number<std::uint8_t>());
      const auto record = inside.take(inside.number<std::uint64_t>());
      if (!inside.ok()) {
        return damaged("a record that does not end in its chunk");
      }
      if ((op == Op::kChannel || op == Op::kMessage) && !take(op, record)) {
        return false;
      }
    }
    return true;
  }

  bool take(Op op, std::string_view body) {
    McapBytes fields(body);
    if (op == Op::kChannel) {
      const auto id = fields.number<std::uint16_t>();
      fields.take(sizeof(std::uint16_t));  // schema
      const auto topic = fields.text();
      const auto encoding = fields.text();
      channels_[id] = {std::string(topic), std::string(encoding)};
      return fields.ok() || damaged("a channel whose fields do not end");
    }
    McapMessage message;
    message.channel = fields.number<std::uint16_t>();
    fields.take(sizeof(std::uint32_t));  // sequence
    message.log_time_ns = fields.number<std::uint64_t>();
    fields.take(sizeof(std::uint64_t));  // publish time
    message.data = fields.left();
    if (!fields.ok() || !channels_.contains(message.channel)) {
      return damaged("a message of no channel");
    }
    stopped_ = !visit_(message, channels_);
    return true;
  }

  std::ifstream file_;
  const McapVisitor& visit_;
  McapChannels channels_;
  McapEnd end_;
  std::string body_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;
  bool stopped_ = false;
};

}  // namespace

McapEnd read_mcap(const std::filesystem::path& path, const McapVisitor& visit) {
  return McapReader(path, visit).read();
}

}  // namespace towbench::study::logs
