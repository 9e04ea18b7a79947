// Files of the object cache (object_cache.h), by POSIX calls: ownership, links and renames matter here.
#include "runtime/object_cache.h"

#include <llvm/Support/BLAKE3.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace moonshade {

namespace {

constexpr std::string_view kEnding = ".shader";
constexpr std::string_view kTemporary = ".tmp";
constexpr std::array<char, 8> kMagic = {'m', 's', 'h', 'a', 'd', 'e', '0', '1'};
/// Temporary files older than this are left over from a process that died.
constexpr time_t kStale = 3600;

/// The head of a file; the payload follows.
struct Header {
  std::array<char, 8> magic = kMagic;
  uint64_t size = 0; ///< of the payload
  CacheKey key{};
  std::array<uint8_t, 32> hash{}; ///< of what stands before it, and of the payload
};
static_assert(sizeof(Header) == 80);

std::array<uint8_t, 32> hash_of(const Header& header, std::string_view payload) {
  llvm::BLAKE3 hasher;
  hasher.update(llvm::ArrayRef(reinterpret_cast<const uint8_t*>(&header), offsetof(Header, hash)));
  hasher.update(llvm::StringRef(payload.data(), payload.size()));
  return hasher.final();
}

class File {
public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  explicit operator bool() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  bool close() { return descriptor_ < 0 || ::close(std::exchange(descriptor_, -1)) == 0; }

  bool read_all(char* to, size_t size) const {
    while (size != 0) {
      const ssize_t got = ::read(descriptor_, to, size);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      to += got;
      size -= static_cast<size_t>(got);
    }
    return true;
  }
  bool write_all(const char* from, size_t size) const {
    while (size != 0) {
      const ssize_t put = ::write(descriptor_, from, size);
      if (put < 0 && errno == EINTR) continue;
      if (put <= 0) return false;
      from += put;
      size -= static_cast<size_t>(put);
    }
    return true;
  }

private:
  int descriptor_;
};

/// A plain file of this user that nobody else can write to.
bool is_ours(const struct stat& facts) {
  return S_ISREG(facts.st_mode) && facts.st_uid == ::geteuid() && (facts.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Reads and checks an entry; false with an empty payload where something is wrong with it.
bool read_entry(const File& file, const struct stat& facts, const CacheKey& key, std::string& payload) {
  Header header;
  if (!is_ours(facts) || facts.st_size < static_cast<off_t>(sizeof header)) return false;
  if (!file.read_all(reinterpret_cast<char*>(&header), sizeof header)) return false;
  const uint64_t size = static_cast<uint64_t>(facts.st_size) - sizeof header;
  if (header.magic != kMagic || header.key != key || header.size != size) return false;
  payload.resize(size);
  if (file.read_all(payload.data(), size) && hash_of(header, payload) == header.hash) return true;
  payload.clear();
  return false;
}

} // namespace

std::string ObjectCache::path_of(const CacheKey& key) const {
  constexpr char digits[] = "0123456789abcdef";
  std::string name;
  for (const uint8_t byte : key) {
    name += digits[byte >> 4];
    name += digits[byte & 15];
  }
  return folder_ + "/" + name + std::string(kEnding);
}

std::optional<std::string> ObjectCache::find(const CacheKey& key) {
  const File file(::open(path_of(key).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat facts{};
  if (!file || ::fstat(file.descriptor(), &facts) != 0) {
    ++misses_;
    return std::nullopt;
  }
  std::string payload;
  if (!read_entry(file, facts, key, payload)) {
    reject(key);
    return std::nullopt;
  }
  ++hits_;
  ::futimens(file.descriptor(), nullptr); // used just now
  return payload;
}

void ObjectCache::reject(const CacheKey& key) {
  ++rejected_;
  ++misses_;
  ::unlink(path_of(key).c_str());
}

bool ObjectCache::make_folder() {
  const std::scoped_lock lock(mutex_);
  if (folder_made_) return true;
  std::error_code error;
  const std::filesystem::path path(folder_);
  if (!std::filesystem::is_directory(path, error)) {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    if (::mkdir(folder_.c_str(), S_IRWXU) != 0 && errno != EEXIST) return false;
  }
  return folder_made_ = true;
}

void ObjectCache::store(const CacheKey& key, std::string_view payload) {
  if (payload.size() > limit_ / 4 || !make_folder()) return;
  Header header;
  header.size = payload.size();
  header.key = key;
  header.hash = hash_of(header, payload);
  const std::string path = path_of(key);
  const std::string beside =
      path + "." + std::to_string(::getpid()) + "." + std::to_string(++temporary_) + std::string(kTemporary);
  File file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR));
  if (!file) return;
  const bool whole = file.write_all(reinterpret_cast<const char*>(&header), sizeof header) &&
                     file.write_all(payload.data(), payload.size()) && file.close() &&
                     ::rename(beside.c_str(), path.c_str()) == 0;
  if (!whole) {
    ::unlink(beside.c_str());
    return;
  }
  ++stored_;
  keep_within_limit(sizeof header + payload.size());
}

void ObjectCache::keep_within_limit(uint64_t written) {
  {
    const std::scoped_lock lock(mutex_);
    if (written_since_look_ && (*written_since_look_ += written) < limit_ / 16) return;
    written_since_look_ = 0;
  }
  struct Entry {
    std::string path;
    uint64_t size;
    timespec used;
  };
  std::vector<Entry> entries;
  uint64_t sum = 0;
  const time_t now = ::time(nullptr);
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string path = at->path().string();
    struct stat facts{};
    if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) continue;
    if (path.ends_with(kTemporary) && now - facts.st_mtim.tv_sec > kStale) ::unlink(path.c_str());
    if (!path.ends_with(kEnding)) continue;
    const uint64_t size = static_cast<uint64_t>(facts.st_size);
    entries.push_back({path, size, facts.st_mtim});
    sum += size;
  }
  if (sum <= limit_) return;
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  // To somewhat below the limit, so that the next entries find room.
  for (const Entry& entry : entries) {
    if (sum <= limit_ - limit_ / 8) break;
    if (::unlink(entry.path.c_str()) == 0) sum -= entry.size;
  }
}

std::shared_ptr<ObjectCache> open_object_cache(const std::string& folder, uint64_t limit) {
  return folder.empty() ? nullptr : std::make_shared<ObjectCache>(folder, limit);
}

CacheCounts cache_counts(const ObjectCache& cache) { return cache.counts(); }

std::string default_cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  // A path that is not absolute counts as none, says the XDG base directory specification.
  if (const std::string base = variable("XDG_CACHE_HOME"); base.starts_with('/')) return base + "/moonshade";
  if (const std::string home = variable("HOME"); home.starts_with('/')) return home + "/.cache/moonshade";
  return "";
}

} // namespace moonshade
