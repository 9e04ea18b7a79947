// The file: a line that says what it is, the parts of the identity, the state, and eight bytes of hash over all of it,
// taken in blocks so that writing and checking need no memory to speak of.
#include "renderer/checkpoint/checkpoint_file.h"

#include <OpenImageIO/hash.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>
#include <vector>

namespace moonshade::renderer {

namespace {

constexpr char kMagic[] = "Moonshade checkpoint, version 1\n";
constexpr size_t kBlock = size_t(1) << 20;
constexpr size_t kHashBytes = sizeof(uint64_t);

uint64_t hash_block(const char* data, size_t size, uint64_t before) { return OIIO::xxhash::xxhash(data, size, before); }

/// A file descriptor that closes itself.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

class Writer : public Archive {
public:
  explicit Writer(int file) : file_(file) { block_.reserve(kBlock); }

  bool reading() const override { return false; }
  bool ok() const override { return error_ == 0; }
  void fail() override {
    if (error_ == 0) error_ = EIO;
  }
  void bytes(void* data, size_t size) override {
    const char* from = static_cast<const char*>(data);
    while (size > 0 && ok()) {
      size_t taken = std::min(size, kBlock - block_.size());
      block_.insert(block_.end(), from, from + taken);
      from += taken, size -= taken;
      if (block_.size() == kBlock) flush();
    }
  }
  /// The rest and the hash, all the way to the disk. The error, or 0.
  int finish() {
    if (!block_.empty()) flush();
    uint64_t hash = hash_;
    write(reinterpret_cast<const char*>(&hash), sizeof hash);
    if (ok() && ::fsync(file_) != 0) error_ = errno;
    return error_;
  }

private:
  void flush() {
    hash_ = hash_block(block_.data(), block_.size(), hash_);
    write(block_.data(), block_.size());
    block_.clear();
  }
  void write(const char* data, size_t size) {
    while (size > 0 && ok()) {
      ssize_t count = ::write(file_, data, size);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0)
        error_ = errno;
      else if (count == 0)
        error_ = EIO;
      else
        data += count, size -= size_t(count);
    }
  }

  int file_;
  int error_ = 0;
  uint64_t hash_ = 0;
  std::vector<char> block_;
};

class Reader : public Archive {
public:
  explicit Reader(int file) { file_.number = file; }

  bool reading() const override { return true; }
  bool ok() const override { return ok_; }
  void fail() override { ok_ = false; }
  void bytes(void* data, size_t size) override {
    char* to = static_cast<char*>(data);
    while (size > 0 && ok_) {
      if (at_ == block_.size() && !refill()) return fail();
      size_t taken = std::min(size, block_.size() - at_);
      std::memcpy(to, block_.data() + at_, taken);
      to += taken, at_ += taken, size -= taken;
    }
  }
  /// Does the hash at the end fit? Leaves the file at its beginning.
  bool whole() {
    off_t size = ::lseek(file_.number, 0, SEEK_END);
    if (size < off_t(kHashBytes)) return false;
    left_ = uint64_t(size) - kHashBytes;
    uint64_t all = left_, hash = 0, expected = 0;
    ::lseek(file_.number, 0, SEEK_SET);
    while (left_ > 0) {
      if (!refill()) return false;
      hash = hash_block(block_.data(), block_.size(), hash);
    }
    if (::read(file_.number, &expected, sizeof expected) != ssize_t(sizeof expected) || hash != expected) return false;
    ::lseek(file_.number, 0, SEEK_SET);
    left_ = all, at_ = 0;
    block_.clear();
    return true;
  }

private:
  bool refill() {
    block_.resize(size_t(std::min<uint64_t>(left_, kBlock)));
    size_t done = 0;
    while (done < block_.size()) {
      ssize_t count = ::read(file_.number, block_.data() + done, block_.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      done += size_t(count);
    }
    left_ -= block_.size();
    at_ = 0;
    return !block_.empty();
  }

  Descriptor file_;
  bool ok_ = true;
  uint64_t left_ = 0;
  size_t at_ = 0;
  std::vector<char> block_;
};

void exchange(Archive& archive, Identity& identity) {
  char magic[sizeof kMagic];
  std::memcpy(magic, kMagic, sizeof kMagic);
  archive.bytes(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof kMagic) != 0) return archive.fail();
  uint32_t count = uint32_t(identity.parts.size());
  archive.value(count);
  if (!archive.reading()) {
    for (auto& [name, value] : identity.parts) {
      std::string key = name;
      archive.text(key), archive.text(value);
    }
    return;
  }
  for (uint32_t k = 0; k < count && archive.ok(); ++k) {
    std::string name, value;
    archive.text(name), archive.text(value);
    identity.parts[name] = value;
  }
}

/// Makes the rename itself lasting.
void sync_folder(const std::string& path) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Descriptor descriptor{::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY)};
  if (descriptor.number >= 0) ::fsync(descriptor.number);
}

} // namespace

std::string checkpoint_path(const std::string& image) { return image + ".checkpoint"; }

std::string write_checkpoint(const std::string& path, const Identity& identity, RenderState& state) {
  // One name, so that what a killed render leaves is overwritten by the next one; but in a folder of many users a link
  // of that name may be another's.
  std::string temporary = path + ".new";
  int error = 0;
  {
    Descriptor file{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666)};
    if (file.number < 0) return path + ": " + std::strerror(errno);
    Writer writer(file.number);
    Identity copy = identity;
    exchange(writer, copy);
    state.exchange(writer);
    error = writer.finish();
  }
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    return path + ": " + std::strerror(error);
  }
  sync_folder(path);
  return "";
}

OpenedCheckpoint open_checkpoint(const std::string& path, const Identity& identity) {
  int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // of a pipe, too: which is damaged, then
  if (file < 0 && errno == ENOENT) return {};
  if (file < 0) return {nullptr, path + ": " + std::strerror(errno)};
  auto reader = std::make_unique<Reader>(file);
  if (!reader->whole()) return {nullptr, path + ": the checkpoint is damaged; delete it to begin anew"};
  Identity found;
  exchange(*reader, found);
  if (!reader->ok()) return {nullptr, path + ": is no checkpoint of this version; delete it to begin anew"};
  if (std::string what = difference(found, identity); !what.empty())
    return {nullptr, path + ": the checkpoint is another render's: " + what + "; delete it to begin anew"};
  return {std::move(reader), ""};
}

} // namespace moonshade::renderer
