// A test framework of one page: TEST registers, CHECK counts, main() runs all and says which failed.
#ifndef PLANISH_CHECK_HPP
#define PLANISH_CHECK_HPP

#include <planish.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <type_traits>
#include <vector>

namespace check {

struct test {
  const char *group, *name;
  void (*body)();
};

inline std::vector<test> &tests() {
  static std::vector<test> all;
  return all;
}

inline int failures = 0;

inline bool add(const char *group, const char *name, void (*body)()) {
  tests().push_back({group, name, body});
  return true;
}

inline void that(bool holds, const char *text, const char *file, int line) {
  if (holds) return;
  ++failures;
  std::printf("%s:%d: not true: %s\n", file, line, text);
}

template <class T>
void equal(const T &found, const T &expected, const char *text, const char *file, int line) {
  if (found == expected) return;
  ++failures;
  std::printf("%s:%d: %s is %s, not %s\n", file, line, text, std::to_string(found).c_str(),
              std::to_string(expected).c_str());
}

inline void near(double found, double expected, double tolerance, const char *text, const char *file, int line) {
  const double off = found > expected ? found - expected : expected - found;
  if (off <= tolerance) return; // false for NaN
  ++failures;
  std::printf("%s:%d: %s is %.17g, off %.17g by %.3g, allowed are %.3g\n", file, line, text, found, expected, off,
              tolerance);
}

inline std::string last_sentence() {
  std::string text(planish_error_message(nullptr, 0), '\0');
  planish_error_message(text.data(), text.size() + 1);
  return text;
}

// The call failed with this status, blames this index, and its sentence has these words.
inline void fails(planish_status found, planish_status expected, long long index, const char *words,
                  const char *text, const char *file, int line) {
  const std::string sentence = last_sentence();
  if (found != expected) {
    ++failures;
    std::printf("%s:%d: %s returned %s, not %s (%s)\n", file, line, text, planish_status_name(found),
                planish_status_name(expected), sentence.c_str());
    return;
  }
  if (planish_error_index() != index) {
    ++failures;
    std::printf("%s:%d: %s blames %lld, not %lld\n", file, line, text,
                static_cast<long long>(planish_error_index()), index);
  }
  if (sentence.find(words) == std::string::npos) {
    ++failures;
    std::printf("%s:%d: %s says \"%s\", which lacks \"%s\"\n", file, line, text, sentence.c_str(), words);
  }
}

// Some memory that a failing call must leave as it is, to the byte.
class untouched {
 public:
  untouched(const void *memory, std::size_t size)
      : memory_(memory), copy_(static_cast<const char *>(memory), static_cast<const char *>(memory) + size) {}
  template <class T>
  explicit untouched(const std::vector<T> &numbers) : untouched(numbers.data(), numbers.size() * sizeof(T)) {}
  template <class T>
  explicit untouched(const T &object) : untouched(&object, sizeof object) {}

  bool holds() const { return std::memcmp(memory_, copy_.data(), copy_.size()) == 0; }

 private:
  const void *memory_;
  std::vector<char> copy_;
};

// All tests, or those whose name has the text that PLANISH_TEST is set to.
inline int run() {
  const char *wanted = std::getenv("PLANISH_TEST");
  int failed = 0;
  std::size_t count = 0;
  for (const test &t : tests()) {
    if (wanted && !std::strstr(t.name, wanted)) continue;
    ++count;
    const int before = failures;
    try {
      t.body();
    } catch (const std::exception &thrown) {
      ++failures;
      std::printf("%s.%s threw: %s\n", t.group, t.name, thrown.what());
    }
    if (failures > before) {
      ++failed;
      std::printf("FAILED %s.%s\n", t.group, t.name);
    }
    std::fflush(stdout);
  }
  std::printf("%zu tests, %d failed\n", count, failed);
  return failed != 0 || count == 0;
}

} // namespace check

#define TEST(group, name)                                                                        \
  static void group##_##name();                                                                  \
  [[maybe_unused]] static const bool group##_##name##_added = check::add(#group, #name, group##_##name); \
  static void group##_##name()

#define CHECK(condition) check::that((condition), #condition, __FILE__, __LINE__)
#define CHECK_EQUAL(found, expected) \
  check::equal<std::common_type_t<decltype(found), decltype(expected)>>((found), (expected), #found, __FILE__, __LINE__)
#define CHECK_NEAR(found, expected, tolerance) \
  check::near((found), (expected), (tolerance), #found, __FILE__, __LINE__)
#define CHECK_FAILS(call, status, index, words) \
  check::fails((call), (status), (index), (words), #call, __FILE__, __LINE__)

#endif
