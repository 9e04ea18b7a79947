// A bump allocator for the nodes of one compilation: freed all at once, destructors never run, so only trivially
// destructible types may live here. Strings and arrays that nodes hold are copied into it too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace moonshade {

class Arena {
public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  Arena(Arena&&) = default;
  Arena& operator=(Arena&&) = default;

  /// A new T, constructed from the arguments.
  template <class T, class... Args> T* make(Args&&... args) {
    static_assert(std::is_trivially_destructible_v<T>, "an arena never runs destructors");
    return new (allocate(sizeof(T), alignof(T))) T{std::forward<Args>(args)...};
  }

  /// `count` value-initialised elements.
  template <class T> std::span<T> make_array(size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "an arena never runs destructors");
    if (count == 0) return {};
    T* first = static_cast<T*>(allocate(sizeof(T) * count, alignof(T)));
    std::uninitialized_value_construct_n(first, count);
    return {first, count};
  }

  /// A copy of the elements.
  template <class T> std::span<T> copy(std::span<const T> elements) {
    static_assert(std::is_trivially_destructible_v<T>, "an arena never runs destructors");
    if (elements.empty()) return {};
    T* first = static_cast<T*>(allocate(elements.size_bytes(), alignof(T)));
    std::uninitialized_copy(elements.begin(), elements.end(), first);
    return {first, elements.size()};
  }
  template <class T> std::span<T> copy(const std::vector<T>& elements) { return copy(std::span<const T>(elements)); }

  /// A copy of the text (no terminating zero).
  std::string_view copy(std::string_view text) {
    if (text.empty()) return {};
    char* first = static_cast<char*>(allocate(text.size(), 1));
    std::memcpy(first, text.data(), text.size());
    return {first, text.size()};
  }

  /// Bytes handed out so far, padding included.
  size_t bytes_used() const { return bytes_used_; }

private:
  static constexpr size_t kBlockSize = 64 * 1024;

  void* allocate(size_t size, size_t alignment) {
    size_t padding = (alignment - reinterpret_cast<uintptr_t>(next_) % alignment) % alignment;
    if (size + padding > static_cast<size_t>(end_ - next_)) {
      start_block(size + alignment);
      padding = (alignment - reinterpret_cast<uintptr_t>(next_) % alignment) % alignment;
    }
    std::byte* result = next_ + padding;
    next_ = result + size;
    bytes_used_ += size + padding;
    return result;
  }

  void start_block(size_t least) {
    const size_t size = least > kBlockSize ? least : kBlockSize;
    blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(size));
    next_ = blocks_.back().get();
    end_ = next_ + size;
  }

  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::byte* next_ = nullptr;
  std::byte* end_ = nullptr;
  size_t bytes_used_ = 0;
};

} // namespace moonshade
