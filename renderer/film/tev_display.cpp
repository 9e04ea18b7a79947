// A viewer that does not answer must not hold up the render: sending gives up after some seconds.
#include "renderer/film/tev_display.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace moonshade::renderer {

static_assert(std::endian::native == std::endian::little, "packets are little-endian");

namespace {

constexpr const char* kChannels[] = {"R", "G", "B"};
enum PacketKind : char { kCreateImage = 4, kUpdateImage = 6 };

class Packet {
public:
  explicit Packet(PacketKind kind) : bytes_(4, '\0') { bytes_ += char(kind); }
  template <typename T> Packet& number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Packet& text(const char* text) {
    bytes_.append(text, std::strlen(text) + 1);
    return *this;
  }
  Packet& data(const void* data, size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  std::string finish() {
    uint32_t size = uint32_t(bytes_.size()); // itself included
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

private:
  std::string bytes_;
};

} // namespace

std::string TevDisplay::create_packet(const std::string& name, int width, int height) {
  Packet packet(kCreateImage);
  packet.number<uint8_t>(1).text(name.c_str()).number<int32_t>(width).number<int32_t>(height).number<int32_t>(3);
  for (const char* channel : kChannels)
    packet.text(channel);
  return packet.finish();
}

std::string TevDisplay::update_packet(const std::string& name, const Picture& picture) {
  Packet packet(kUpdateImage);
  packet.number<uint8_t>(0).text(name.c_str()).number<int32_t>(3);
  for (const char* channel : kChannels)
    packet.text(channel);
  packet.number<int32_t>(0).number<int32_t>(0).number<int32_t>(picture.width).number<int32_t>(picture.height);
  for (int64_t offset : {0, 1, 2})
    packet.number(offset);
  for (int64_t stride : {3, 3, 3})
    packet.number(stride);
  packet.data(picture.pixels.data(), picture.pixels.size() * sizeof picture.pixels[0]);
  return packet.finish();
}

TevDisplay::~TevDisplay() {
  if (socket_ >= 0) ::close(socket_);
}

std::string TevDisplay::connect(const std::string& place) {
  size_t colon = place.rfind(':');
  std::string host = place.substr(0, colon), port = colon == std::string::npos ? "" : place.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (host.empty()) host = kHost;
  if (port.empty()) port = kPort;
  place_ = host + ":" + port;
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0)
    return "tev at " + place_ + ": " + ::gai_strerror(error);
  int error = ECONNREFUSED;
  for (addrinfo* a = found; a && socket_ < 0; a = a->ai_next) {
    int socket = ::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (socket < 0) continue;
    timeval patience{5, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience); // bounds connecting, too
    if (::connect(socket, a->ai_addr, a->ai_addrlen) == 0) {
      socket_ = socket;
    } else {
      error = errno == EINPROGRESS ? ETIMEDOUT : errno;
      ::close(socket);
    }
  }
  ::freeaddrinfo(found);
  return socket_ >= 0 ? "" : "tev at " + place_ + ": " + std::strerror(error);
}

std::string TevDisplay::send_all(const std::string& bytes) {
  for (size_t done = 0; done < bytes.size();) {
    ssize_t count = ::send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      std::string error =
          "tev at " + place_ + ": " + (errno == EAGAIN ? "does not take the picture" : std::strerror(errno));
      ::close(socket_);
      socket_ = -1;
      return error;
    }
    done += size_t(count);
  }
  return "";
}

std::string TevDisplay::show(const std::string& name, const Picture& picture) {
  if (!connected()) return "";
  // A packet's length has 32 bits, of which tev takes 31.
  if (picture.pixels.size() * sizeof(Vec3) > size_t(0x7ff00000)) {
    ::close(socket_);
    socket_ = -1;
    return "tev at " + place_ + ": takes no pictures of this size";
  }
  if (shown_ != name || width_ != picture.width || height_ != picture.height) {
    if (std::string error = send_all(create_packet(name, picture.width, picture.height)); !error.empty()) return error;
    shown_ = name, width_ = picture.width, height_ = picture.height;
  }
  return send_all(update_packet(name, picture));
}

} // namespace moonshade::renderer
