// SPDX-License-Identifier: Apache-2.0
#include "io/ping_source.h"

#include <utility>

#include "io/simrad/indexer.h"
#include "io/simrad/ping_reader.h"
#include "io/simrad/raw_format.h"

namespace sonar {
namespace {

/// CON0/RAW0/NME0, the only format whose samples are read so far; files of others are told what they are.
class SimradPings final : public PingSource {
 public:
  explicit SimradPings(std::shared_ptr<const ByteSource> bytes) : bytes_(std::move(bytes)) {}

  [[nodiscard]] const RawIndex& index() const override { return indexer_.index(); }
  [[nodiscard]] Result<Ping> read(std::size_t i, BlockPool& pool) const override {
    return read_ping(*bytes_, header(i), pool);
  }
  Result<std::size_t> refresh() override {
    const std::size_t before = count();
    if (auto done = indexer_.refresh(*bytes_); !done) return pass_on(done);
    return count() - before;
  }
  Result<void> finish() override {
    auto done = indexer_.finish(*bytes_);
    final_ = done.has_value();
    return done;
  }
  [[nodiscard]] bool final() const override { return final_; }

 private:
  std::shared_ptr<const ByteSource> bytes_;
  simrad::Indexer indexer_;
  bool final_ = false;
};

class IndexedPings final : public PingSource {
 public:
  IndexedPings(std::shared_ptr<const ByteSource> bytes, RawIndex index)
      : bytes_(std::move(bytes)), index_(std::move(index)) {}

  [[nodiscard]] const RawIndex& index() const override { return index_; }
  [[nodiscard]] Result<Ping> read(std::size_t i, BlockPool& pool) const override {
    return read_ping(*bytes_, header(i), pool);
  }
  Result<std::size_t> refresh() override { return std::size_t{0}; }
  Result<void> finish() override { return {}; }
  [[nodiscard]] bool final() const override { return true; }

 private:
  std::shared_ptr<const ByteSource> bytes_;
  RawIndex index_;
};

}  // namespace

std::unique_ptr<PingSource> ping_source(std::shared_ptr<const ByteSource> bytes, RawIndex index) {
  return std::make_unique<IndexedPings>(std::move(bytes), std::move(index));
}

std::unique_ptr<PingSource> ping_source(std::shared_ptr<const ByteSource> bytes) {
  return std::make_unique<SimradPings>(std::move(bytes));
}

Result<RawIndex> index_raw(const ByteSource& bytes) {
  simrad::Indexer indexer;
  if (auto done = indexer.finish(bytes); !done) return pass_on(done);
  return indexer.take();
}

Result<Ping> read_ping(const ByteSource& bytes, const PingEntry& entry, BlockPool& pool) {
  return simrad::read_ping(bytes, entry, pool);
}

Result<Ping> read_ping(const ByteSource& bytes, const PingEntry& entry) {
  BlockPool pool(0);
  return read_ping(bytes, entry, pool);
}

UnreadFormat unread_format(const ByteSource& bytes, RawFormat format) {
  if (format != RawFormat::ek80) return {};
  return {"EK80", simrad::ek80_channels(bytes).value_or(0)};
}

}  // namespace sonar
