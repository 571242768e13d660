// Contenders at the same job, timed side by side.
#ifndef PLANISH_PEERS_RACE_HPP
#define PLANISH_PEERS_RACE_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace race {

// Runs of which the median is printed.
constexpr std::size_t runs = 5;

struct Contender {
  std::string name;
  std::size_t points;
  std::function<void()> run;
};

// Seconds of processor time that this process has used: what others do on the machine does not count.
inline double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Times all contenders and prints a line for each: what, who, and million points a second as median, least and
// largest. Each round lets everyone run once, so that a slow minute of the machine is everyone's. All must have
// run before: this first run makes pages and caches warm, and its results have been compared.
inline void print(const std::string &what, const std::vector<Contender> &contenders) {
  std::vector<std::array<double, runs>> rates(contenders.size());
  for (std::size_t round = 0; round < runs; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double start = cpu_seconds();
      contenders[i].run();
      rates[i][round] = 1e-6 * static_cast<double>(contenders[i].points) / (cpu_seconds() - start);
    }
  }
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::sort(rates[i].begin(), rates[i].end());
    std::printf("rate\t%s\t%s\t%.4g\t%.4g\t%.4g\n", what.c_str(), contenders[i].name.c_str(),
                rates[i][runs / 2], rates[i].front(), rates[i].back());
  }
  std::fflush(stdout);
}

// Seconds that a run takes, as text: median, least and largest, or those of its only run if they are more than one.
inline std::string seconds(const std::function<void()> &run) {
  char text[64];
  const double begin = cpu_seconds();
  run();
  const double first = cpu_seconds() - begin;
  if (first >= 1) {
    std::snprintf(text, sizeof text, "%.3g", first);
    return text;
  }
  std::array<double, runs> taken;
  for (double &each : taken) {
    const double start = cpu_seconds();
    run();
    each = cpu_seconds() - start;
  }
  std::sort(taken.begin(), taken.end());
  std::snprintf(text, sizeof text, "%.3g (%.3g to %.3g)", taken[runs / 2], taken.front(), taken.back());
  return text;
}

// The largest difference of two arrays over the largest number of the first.
inline double difference(const std::vector<double> &ours, const std::vector<double> &theirs) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    largest = std::max(largest, std::abs(ours[i]));
    const double d = std::abs(ours[i] - theirs[i]);
    if (!(d <= apart)) apart = d; // a NaN stays
  }
  return apart / largest;
}

} // namespace race

#endif
