// Compiled shaders kept on disk between processes: the store itself (shader.h has the interface for hosts, cache_key.h
// what a key is made of, program_archive.h what an entry holds).
//
// An entry is a file of its own, named after its key, written beside its place and renamed: readers see it whole or not
// at all, and any number of processes may share a folder without locks. What is read is taken only if the file belongs
// to this user and nobody else can write to it, and if a hash over the key and all of the bytes is right. Machine code
// is run as it stands: whoever can write the files of a user can make him run what he likes, as he can by other files
// of his; nobody else can.
//
// The folder is kept within a limit: a writer that finds more than that in it deletes those that were not used for the
// longest time. It looks when it first writes and after each sixteenth of the limit that it wrote, so the folder may be
// larger by that much for each process that writes at the same time.
#pragma once

#include "runtime/shader.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace moonshade {

using CacheKey = std::array<uint8_t, 32>;

class ObjectCache {
public:
  ObjectCache(std::string folder, uint64_t limit) : folder_(std::move(folder)), limit_(limit) {}

  /// The payload that was stored under the key; nothing where there is none that can be trusted.
  std::optional<std::string> find(const CacheKey& key);
  /// Stores it, where the folder lets it.
  void store(const CacheKey& key, std::string_view payload);
  /// What `find` gave turned out to be of no use.
  void reject(const CacheKey& key);

  CacheCounts counts() const { return {hits_, misses_, rejected_, stored_}; }
  std::string path_of(const CacheKey& key) const;

private:
  bool make_folder();
  void keep_within_limit(uint64_t written);

  const std::string folder_;
  const uint64_t limit_;
  std::atomic<uint64_t> hits_ = 0, misses_ = 0, rejected_ = 0, stored_ = 0, temporary_ = 0;
  std::mutex mutex_; ///< of what follows
  bool folder_made_ = false;
  std::optional<uint64_t> written_since_look_;
};

} // namespace moonshade
