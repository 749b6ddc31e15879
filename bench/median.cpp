// SPDX-License-Identifier: Apache-2.0
// bench_median PING.i16 [REPETITIONS [RIVAL_REPETITIONS]]: the masked median beside ITK's two, on one ping of
// [fan 20][beam 25][sample 1319] counts as make_ping.py writes it. Every answer is checked before it is timed.
#include "signal/median.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "itk_median.h"

namespace sonar::bench {
namespace {

constexpr Shape3 kShape{20, 25, 1319};

struct Times {
  double minimum_ms;
  double median_ms;
};

template <class Body>
Times time(int repetitions, const Body& body) {
  std::vector<double> ms;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    body();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(ms.begin(), ms.end());
  return {ms.front(), ms[ms.size() / 2]};
}

bool read_ping(const std::string& path, Array3<std::int16_t>& ping) {
  std::ifstream file(path, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(ping.all().size_bytes());
  return static_cast<bool>(file.read(reinterpret_cast<char*>(ping.all().data()), bytes)) && file.peek() == EOF;
}

/// Voxels where two volumes differ, `border` beams, fans and 11 border samples left out.
std::size_t differences(const Array3<std::int16_t>& a, const Array3<std::int16_t>& b, int border) {
  std::size_t n = 0;
  for (int f = border; f < kShape.fans - border; ++f) {
    for (int s = 11 * border; s < kShape.samples - 11 * border; ++s) {
      for (int beam = border; beam < kShape.beams - border; ++beam) n += a(f, beam, s) != b(f, beam, s) ? 1U : 0U;
    }
  }
  return n;
}

bool check(const char* what, std::size_t wrong) {
  fmt::print("  {:<44} {} voxels differ from the plain median\n", what, wrong);
  return wrong == 0;
}

void print(const char* what, const Times& times, int repetitions) {
  fmt::print("  {:<44} min {:9.3f} ms  median {:9.3f} ms  (n = {})\n", what, times.minimum_ms, times.median_ms,
             repetitions);
}

int run(const std::string& path, int repetitions, int rival_repetitions) {
  Array3<std::int16_t> ping(kShape);
  if (!read_ping(path, ping)) {
    fmt::print(stderr, "{}: not a ping of 20 x 25 x 1319 counts\n", path);
    return EXIT_FAILURE;
  }
  const Array3<SampleFlags> flags(kShape);
  Array3<std::int16_t> out(kShape);
  Work two(2);
  const auto ours = [&](MedianMethod method, Work* work) {
    median_into(ping.view(), flags.view(), {}, method, work, out.view());
  };

  fmt::print("Answers\n");
  const auto reference = median_reference(ping.view(), flags.view(), {});
  bool right = true;
  ours(MedianMethod::network, nullptr);
  right = check("network", differences(out, reference, 0)) && right;
  ours(MedianMethod::network, &two);
  right = check("network, two threads", differences(out, reference, 0)) && right;
  ours(MedianMethod::histogram, nullptr);
  right = check("sliding histogram", differences(out, reference, 0)) && right;
  right = check("ITK MedianImageFilter", differences(itk_median(ping.view(), 1), reference, 0)) && right;
  right = check("ITK RankImageFilter (interior)", differences(itk_rank(ping.view(), 1), reference, 1)) && right;
  if (!right) return EXIT_FAILURE;

  fmt::print("Times, one ping of 20 x 25 x 1319, box 3 x 3 x 23\n");
  for (const int threads : {1, 2}) {
    Work* work = threads == 1 ? nullptr : &two;
    fmt::print(" {} thread(s)\n", threads);
    const Times network = time(repetitions, [&] { ours(MedianMethod::network, work); });
    const Times histogram = time(std::max(repetitions / 10, 3), [&] { ours(MedianMethod::histogram, work); });
    const Times median = time(rival_repetitions, [&] { static_cast<void>(itk_median(ping.view(), threads)); });
    const Times rank = time(rival_repetitions, [&] { static_cast<void>(itk_rank(ping.view(), threads)); });
    print("network", network, repetitions);
    print("sliding histogram", histogram, std::max(repetitions / 10, 3));
    print("ITK MedianImageFilter", median, rival_repetitions);
    print("ITK RankImageFilter", rank, rival_repetitions);
    fmt::print("  network is {:.0f} x ITK median, {:.0f} x ITK rank (minima); {:.0f} x and {:.0f} x (medians)\n",
               median.minimum_ms / network.minimum_ms, rank.minimum_ms / network.minimum_ms,
               median.median_ms / network.median_ms, rank.median_ms / network.median_ms);
  }

  // As a survey is run: each thread has a ping of its own.
  constexpr int kPings = 64;
  const Times batch = time(5, [&] {
    two.for_each(kPings, [&](std::int64_t) {
      static thread_local Array3<std::int16_t> own(kShape);
      median_into(ping.view(), flags.view(), {}, own.view());
    });
  });
  fmt::print(" pings shared out over 2 threads: {:.3f} ms a ping (best of 5 times {} pings)\n",
             batch.minimum_ms / kPings, kPings);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_median PING.i16 [REPETITIONS [RIVAL_REPETITIONS]]\n");
    return EXIT_FAILURE;
  }
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 100;
  const int rival_repetitions = argc > 3 ? std::atoi(argv[3]) : 3;
  return sonar::bench::run(argv[1], std::max(repetitions, 1), std::max(rival_repetitions, 1));
}
