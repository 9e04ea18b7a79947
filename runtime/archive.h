// Plain values as bytes and back, for the object cache. What reads must expect any bytes at all: it gives up, and never
// reads beyond them or takes memory that they do not warrant. Numbers are as this machine keeps them: a cache is for
// the machine that wrote it.
//
// A struct is archived by a function `fields(archive, value)` beside its use, which names its members by a structured
// binding: a member that is added and not archived does not compile.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace moonshade {

/// The greatest value of an enumeration that is archived: to be specialised for each.
template <class E> constexpr E last_value();

class ArchiveWriter {
public:
  const std::string& bytes() const { return bytes_; }

  template <class... T> void operator()(const T&... values) { (write(values), ...); }

private:
  template <class T> void write(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      fields(*this, const_cast<T&>(value)); // which reads it only
    }
  }
  void write(const std::string& text) {
    write(uint64_t{text.size()});
    bytes_ += text;
  }
  template <class T> void write(const std::vector<T>& values) {
    write(uint64_t{values.size()});
    for (const T& value : values)
      write(value);
  }
  template <class T> void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class A, class B> void write(const std::pair<A, B>& value) {
    write(value.first);
    write(value.second);
  }
  template <class... T> void write(const std::variant<T...>& value) {
    write(static_cast<uint8_t>(value.index()));
    std::visit([&](const auto& held) { write(held); }, value);
  }

  std::string bytes_;
};

class ArchiveReader {
public:
  explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}

  /// All was there, of values that can be, and nothing is left.
  bool complete() const { return good_ && rest_.empty(); }

  template <class... T> void operator()(T&... values) { (read(values), ...); }

private:
  template <class T> void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      uint8_t byte = 0;
      read(byte);
      value = byte != 0;
      if (byte > 1) good_ = false;
    } else if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      read(number);
      value = static_cast<T>(number);
      if (value > last_value<T>()) value = T{}, good_ = false;
    } else if constexpr (std::is_arithmetic_v<T>) {
      if (!good_ || rest_.size() < sizeof value) {
        value = {};
        good_ = false;
        return;
      }
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.remove_prefix(sizeof value);
    } else {
      fields(*this, value);
    }
  }
  /// How many elements follow, each of a byte at least.
  size_t read_count() {
    uint64_t count = 0;
    read(count);
    if (count > rest_.size()) good_ = false;
    return good_ ? count : 0;
  }
  void read(std::string& text) {
    const size_t size = read_count();
    text.assign(rest_.substr(0, size));
    rest_.remove_prefix(size);
  }
  template <class T> void read(std::vector<T>& values) {
    values.clear();
    const size_t count = read_count();
    for (size_t i = 0; i < count && good_; ++i)
      read(values.emplace_back());
  }
  template <class T> void read(std::optional<T>& value) {
    bool present = false;
    read(present);
    if (present)
      read(value.emplace());
    else
      value.reset();
  }
  template <class A, class B> void read(std::pair<A, B>& value) {
    read(value.first);
    read(value.second);
  }
  template <class... T> void read(std::variant<T...>& value) {
    uint8_t index = 0;
    read(index);
    if (index >= sizeof...(T)) return void(good_ = false);
    uint8_t at = 0;
    (void)((at++ == index ? (read(value.template emplace<T>()), true) : false) || ...);
  }

  std::string_view rest_;
  bool good_ = true;
};

} // namespace moonshade
