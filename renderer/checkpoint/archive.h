// What a render remembers, as bytes, in one function for both ways: exchange(archive) writes what is there or puts what
// was read in its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace moonshade::renderer {

class Archive {
public:
  virtual ~Archive() = default;
  virtual bool reading() const = 0;
  /// After a failure nothing happens any more.
  virtual void bytes(void* data, size_t size) = 0;
  virtual bool ok() const = 0;
  virtual void fail() = 0;

  template <typename T> void value(T& v) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    bytes(&v, sizeof v);
  }
  void text(std::string& text) {
    uint64_t size = text.size();
    value(size);
    if (size > kLongestText) return fail();
    if (ok()) text.resize(size);
    bytes(text.data(), text.size());
  }
  /// What must be the same on both sides.
  template <typename T> void expect(T v) {
    T other = v;
    value(other);
    if (other != v) fail();
  }

private:
  static constexpr uint64_t kLongestText = uint64_t(64) << 20;
};

} // namespace moonshade::renderer
