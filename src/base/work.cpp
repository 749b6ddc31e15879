// SPDX-License-Identifier: Apache-2.0
#include "base/work.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#ifndef SONAR_PLAIN_THREADS
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace sonar {

struct Work::Pool {
  std::mutex progress_mutex;
  ProgressSink sink;
#ifndef SONAR_PLAIN_THREADS
  // An arena of more threads than there are gets no more of them, only a warning on standard error.
  explicit Pool(int threads) : arena(std::min(threads, tbb::info::default_concurrency())) {}
  tbb::task_arena arena;
#else
  explicit Pool(int) {}
#endif
};

namespace {

/// Each thread holds a few pings: unasked, a machine of many cores must not cost the memory of many.
constexpr int kMostDefaultThreads = 16;

int default_threads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostDefaultThreads);
}

}  // namespace

Work::Work(int threads)
    : threads_(threads > 0 ? threads : default_threads()), pool_(std::make_unique<Pool>(threads_)) {}

Work::~Work() = default;

#ifndef SONAR_PLAIN_THREADS

void Work::for_each(std::int64_t count, const std::function<void(std::int64_t)>& body) {
  pool_->arena.execute([&] {
    // A grain of one keeps neighbours in time on different threads, so that memory in flight stays at one ping a
    // thread.
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, count, 1),
        [&](const tbb::blocked_range<std::int64_t>& range) {
          for (std::int64_t i = range.begin(); i < range.end() && !cancelled(); ++i) body(i);
        },
        tbb::simple_partitioner{});
  });
}

#else

// oneTBB is not built for the thread sanitizer, which then reports its internals; plain threads see the same bodies.
void Work::for_each(std::int64_t count, const std::function<void(std::int64_t)>& body) {
  std::atomic<std::int64_t> next{0};
  std::mutex error_mutex;
  std::exception_ptr error;
  const auto run = [&] {
    for (std::int64_t i = next++; i < count && !cancelled(); i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::scoped_lock lock(error_mutex);
        if (!error) error = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (std::int64_t i = 1; i < std::min<std::int64_t>(threads_, count); ++i) helpers.emplace_back(run);
  run();
  helpers.clear();
  if (error) std::rethrow_exception(error);
}

#endif

void Work::set_progress(ProgressSink sink) {
  const std::scoped_lock lock(pool_->progress_mutex);
  pool_->sink = std::move(sink);
}

Work::ProgressSink Work::exchange_progress(ProgressSink sink) {
  const std::scoped_lock lock(pool_->progress_mutex);
  return std::exchange(pool_->sink, std::move(sink));
}

void Work::progress(std::string_view stage, std::int64_t done, std::int64_t total) {
  const std::scoped_lock lock(pool_->progress_mutex);
  if (pool_->sink) pool_->sink(stage, done, total);
}

}  // namespace sonar
