// Numbers from and to text, as far as libc++'s archive here lacks them.
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace std {
namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

// The end of the longest number at `first` that from_chars takes: no plus, no blanks, no hexadecimal digits.
const char* end_of_number(const char* first, const char* last) {
  const char* at = first;
  if (at < last && *at == '-') ++at;
  for (const char* word : {"infinity", "inf", "nan"}) {
    const size_t size = strlen(word);
    if (static_cast<size_t>(last - at) >= size && strncasecmp(at, word, size) == 0) return at + size;
  }
  const char* digits = at;
  while (at < last && is_digit(*at)) ++at;
  auto count = at - digits;
  if (at < last && *at == '.') {
    const char* fraction = at + 1;
    while (fraction < last && is_digit(*fraction)) ++fraction;
    count += fraction - at - 1;
    if (count > 0) at = fraction;
  }
  if (count == 0) return first;
  if (at < last && (*at == 'e' || *at == 'E')) {
    const char* power = at + 1;
    if (power < last && (*power == '+' || *power == '-')) ++power;
    if (power < last && is_digit(*power)) {
      while (power < last && is_digit(*power)) ++power;
      at = power;
    }
  }
  return at;
}

to_chars_result put(char* first, char* last, const char* text, int size) {
  if (size < 0 || last - first < size) return {last, errc::value_too_large};
  memcpy(first, text, static_cast<size_t>(size));
  return {first + size, errc{}};
}

constexpr size_t longest = 512;  // of a double, with all digits before its point

// What the standard writes without a format: the shorter of the two, and fixed where they are equally long.
int shortest(char (&text)[longest], double value) {
  char fixed[longest];
  for (int digits = 1; digits <= 17; ++digits) {
    int size = snprintf(text, longest, "%.*e", digits - 1, value);
    if (strtod(text, nullptr) != value && digits < 17) continue;
    const char* e = strchr(text, 'e');
    if (e == nullptr) return size;  // not finite
    const int exponent = atoi(e + 1);
    const int decimals = digits - 1 - exponent;
    const int size_fixed = snprintf(fixed, longest, "%.*f", decimals > 0 ? decimals : 0, value);
    if (size_fixed <= size) {
      memcpy(text, fixed, longest);
      size = size_fixed;
    }
    return size;
  }
  return -1;
}

}  // namespace

from_chars_result from_chars(const char* first, const char* last, double& value) {
  const char* end = end_of_number(first, last);
  if (end == first) return {first, errc::invalid_argument};
  char few[64];
  string many;
  const auto size = static_cast<size_t>(end - first);
  const char* text = few;
  if (size < sizeof(few)) {
    memcpy(few, first, size);
    few[size] = '\0';
  } else {
    many.assign(first, end);
    text = many.c_str();
  }
  errno = 0;
  const double read = strtod(text, nullptr);
  if (errno == ERANGE) return {end, errc::result_out_of_range};
  value = read;
  return {end, errc{}};
}

// Declared by libc++ in its inline namespace.
inline namespace _LIBCPP_ABI_NAMESPACE {

to_chars_result to_chars(char* first, char* last, double value) {
  char text[longest];
  const int size = shortest(text, value);
  return put(first, last, text, size);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
  char text[longest];
  const int size = snprintf(text, longest, format == chars_format::fixed ? "%.*f" : "%.*e", precision, value);
  return put(first, last, text, size);
}

}  // namespace _LIBCPP_ABI_NAMESPACE
}  // namespace std
