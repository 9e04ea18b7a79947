// The header says what each element holds; then each property is read as a number, from text or from bytes. Nothing is
// allocated by what the header promises: only by what the file holds.
#include "renderer/scene/ply_reader.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

namespace moonshade::renderer {

namespace {

enum class Format : uint8_t { Ascii, Little, Big };
enum class Type : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct TypeName {
  std::string_view name, sized;
  Type type;
  size_t bytes;
};
constexpr TypeName kTypes[] = {{"char", "int8", Type::Int8, 1},      {"uchar", "uint8", Type::Uint8, 1},
                               {"short", "int16", Type::Int16, 2},   {"ushort", "uint16", Type::Uint16, 2},
                               {"int", "int32", Type::Int32, 4},     {"uint", "uint32", Type::Uint32, 4},
                               {"float", "float32", Type::Float, 4}, {"double", "float64", Type::Double, 8}};

/// What a property of a vertex is used for: the place of its number.
enum Use : int8_t { kUnused = -1, kX, kY, kZ, kNx, kNy, kNz, kU, kV, kUseCount };
struct UseName {
  std::string_view name;
  Use use;
};
constexpr UseName kUses[] = {{"x", kX},         {"y", kY},         {"z", kZ},  {"nx", kNx}, {"ny", kNy},
                             {"nz", kNz},       {"u", kU},         {"v", kV},  {"s", kU},   {"t", kV},
                             {"texture_u", kU}, {"texture_v", kV}, {"s0", kU}, {"t0", kV}};

struct Property {
  Type type = Type::Float;
  bool is_list = false;
  Type count_type = Type::Uint8; ///< of a list
  Use use = kUnused;
  bool corners = false; ///< the list of a face's vertices
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
public:
  PlyReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}
  Model read();

private:
  bool header();
  bool header_line(std::string_view line);
  bool property(std::span<const std::string_view> words);
  bool element(const Element& element);
  bool vertex(const Element& element);
  bool other(const Element& element, bool face);
  bool list(const Property& property, bool face);

  std::string_view line();
  bool number(Type type, double& value);
  bool word_number(double& value);
  template <typename T> double binary();
  size_t left() const { return bytes_.size() - at_; }

  bool fail(const std::string& message);
  /// ":12" in a text, nothing in bytes.
  std::string place() const { return format_ == Format::Ascii || in_header_ ? ":" + std::to_string(line_) : ""; }

  const std::string& path_;
  std::string_view bytes_;
  size_t at_ = 0, line_ = 0;
  bool in_header_ = true;
  Format format_ = Format::Ascii;
  std::vector<Element> elements_;
  const Element* now_ = nullptr; ///< what is read, for messages: its kind and number
  uint64_t now_number_ = 0;
  MeshBuilder mesh_;
  std::vector<std::vector<uint32_t>> early_faces_; ///< of a file that has them before its vertices
  bool have_vertices_ = false;
  std::vector<uint32_t> corners_;
  std::string error_;
};

bool PlyReader::fail(const std::string& message) {
  error_ = path_ + place() + ": ";
  if (now_) error_ += now_->name.substr(0, 40) + " " + std::to_string(now_number_) + ": ";
  error_ += message;
  return false;
}

/// The next line without its end.
std::string_view PlyReader::line() {
  size_t end = bytes_.find('\n', at_);
  std::string_view text = bytes_.substr(at_, end == std::string_view::npos ? end : end - at_);
  at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
  ++line_;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
    size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

const TypeName* type_named(std::string_view name) {
  for (const TypeName& type : kTypes)
    if (name == type.name || name == type.sized) return &type;
  return nullptr;
}

bool PlyReader::property(std::span<const std::string_view> words) {
  if (elements_.empty()) return fail("a property before any element");
  Property property;
  bool is_list = words.size() == 5 && words[1] == "list";
  if (!is_list && words.size() != 3) return fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
  const TypeName* type = type_named(words[words.size() - 2]);
  const TypeName* count_type = is_list ? type_named(words[2]) : nullptr;
  if (!type || (is_list && !count_type))
    return fail("unknown type '" + std::string(type ? words[2] : words[words.size() - 2]) + "'");
  property.type = type->type;
  Element& element = elements_.back();
  std::string_view name = words.back();
  if (is_list) {
    property.is_list = true;
    property.count_type = count_type->type;
    property.corners = element.name == "face" && (name == "vertex_indices" || name == "vertex_index");
  } else if (element.name == "vertex") {
    for (const UseName& use : kUses)
      if (use.name == name) property.use = use.use;
  }
  element.properties.push_back(property);
  return true;
}

bool PlyReader::header_line(std::string_view text) {
  auto words = words_of(text);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "property") return property(words);
  if (words[0] == "format") {
    if (words.size() == 3 && words[1] == "ascii") return format_ = Format::Ascii, true;
    if (words.size() == 3 && words[1] == "binary_little_endian") return format_ = Format::Little, true;
    if (words.size() == 3 && words[1] == "binary_big_endian") return format_ = Format::Big, true;
    return fail("unknown format");
  }
  if (words[0] != "element") return fail("unknown statement '" + std::string(words[0].substr(0, 40)) + "'");
  Element element;
  if (words.size() != 3) return fail("expected 'element NAME COUNT'");
  element.name = words[1];
  auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  if (error != std::errc() || end != words[2].data() + words[2].size()) return fail("expected 'element NAME COUNT'");
  if (element.count >= Mesh::kNoIndex) return fail("too many elements");
  if (elements_.size() > 1000) return fail("too many kinds of elements");
  elements_.push_back(std::move(element));
  return true;
}

bool PlyReader::header() {
  if (line() != "ply") return fail("does not begin with 'ply'");
  while (at_ < bytes_.size()) {
    std::string_view text = line();
    if (text.size() > 4096) return fail("a line of the header is too long");
    if (words_of(text) == std::vector<std::string_view>{"end_header"}) return true;
    if (!header_line(text)) return false;
  }
  return fail("the header does not end");
}

template <typename T> double PlyReader::binary() {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  if ((format_ == Format::Big) != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  return double(std::bit_cast<T>(raw));
}

bool PlyReader::word_number(double& value) {
  while (at_ < bytes_.size() && std::strchr(" \t\r\n", bytes_[at_]) && bytes_[at_]) {
    if (bytes_[at_] == '\n') ++line_;
    ++at_;
  }
  if (at_ == bytes_.size()) return fail("the file ends too early");
  const char* begin = bytes_.data() + at_;
  const char* all_end = bytes_.data() + bytes_.size();
  auto [end, error] = std::from_chars(begin + (*begin == '+' ? 1 : 0), all_end, value);
  bool ended = end == all_end || std::strchr(" \t\r\n", *end);
  if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN(), error = {};
  if (error != std::errc() || !ended) return fail("expected a number");
  at_ = size_t(end - bytes_.data());
  return true;
}

bool PlyReader::number(Type type, double& value) {
  if (format_ == Format::Ascii) return word_number(value);
  if (left() < kTypes[size_t(type)].bytes) return fail("the file ends too early");
  switch (type) {
  case Type::Int8:
    return value = binary<int8_t>(), true;
  case Type::Uint8:
    return value = binary<uint8_t>(), true;
  case Type::Int16:
    return value = binary<int16_t>(), true;
  case Type::Uint16:
    return value = binary<uint16_t>(), true;
  case Type::Int32:
    return value = binary<int32_t>(), true;
  case Type::Uint32:
    return value = binary<uint32_t>(), true;
  case Type::Float:
    return value = double(binary<float>()), true;
  case Type::Double:
    break;
  }
  return value = binary<double>(), true;
}

/// The numbers of a list; those of a face's corners are kept.
bool PlyReader::list(const Property& property, bool face) {
  double count = 0;
  if (!number(property.count_type, count)) return false;
  if (!(count >= 0) || count != std::floor(count)) return fail("a list cannot have such a length");
  if (count > double(left())) return fail("the file ends too early"); // each takes a byte at least
  bool kept = face && property.corners;
  if (kept) corners_.clear();
  for (uint64_t k = 0; k < uint64_t(count); ++k) {
    double value = 0;
    if (!number(property.type, value)) return false;
    if (!kept) continue;
    if (!(value >= 0 && value < Mesh::kNoIndex) || value != std::floor(value))
      return fail("a vertex cannot have this number");
    corners_.push_back(uint32_t(value));
  }
  return true;
}

bool PlyReader::vertex(const Element& element) {
  double values[kUseCount] = {};
  for (const Property& property : element.properties) {
    double value = 0;
    if (property.is_list ? !list(property, false) : !number(property.type, value)) return false;
    if (property.use != kUnused) values[property.use] = value;
  }
  auto uses = [&](Use use) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& p) { return p.use == use; });
  };
  mesh_.positions().emplace_back(values[kX], values[kY], values[kZ]);
  if (uses(kNx)) mesh_.normals().emplace_back(values[kNx], values[kNy], values[kNz]);
  if (uses(kU)) mesh_.uvs().emplace_back(values[kU], values[kV]);
  return true;
}

bool PlyReader::other(const Element& element, bool face) {
  corners_.clear();
  for (const Property& property : element.properties) {
    double value = 0;
    if (property.is_list ? !list(property, face) : !number(property.type, value)) return false;
  }
  if (!face || corners_.empty()) return true;
  if (!have_vertices_) return early_faces_.push_back(corners_), true;
  std::string error = mesh_.face(corners_);
  return error.empty() || fail(error);
}

bool PlyReader::element(const Element& element) {
  bool is_vertex = element.name == "vertex", is_face = element.name == "face";
  for (uint64_t k = 0; k < element.count; ++k) {
    if (element.properties.empty()) break; // nothing to read, however many there are
    now_ = &element, now_number_ = k;
    if (is_vertex ? !vertex(element) : !other(element, is_face)) return false;
  }
  now_ = nullptr;
  have_vertices_ |= is_vertex;
  return true;
}

Model PlyReader::read() {
  Model model;
  bool ok = header();
  in_header_ = false;
  for (size_t k = 0; ok && k < elements_.size(); ++k)
    ok = element(elements_[k]);
  for (size_t k = 0; ok && k < early_faces_.size(); ++k)
    if (std::string error = mesh_.face(early_faces_[k]); !error.empty()) ok = fail(error);
  if (!ok) return model.error = error_, model;
  Object object;
  object.name = path_;
  object.mesh = mesh_.finish(path_, model.warnings);
  if (!object.mesh) return model.error = path_ + ": has no faces", model;
  object.materials = {0};
  Material material;
  material.name = "default";
  material.place = path_;
  model.materials.push_back(material);
  model.objects.push_back(std::move(object));
  return model;
}

} // namespace

Model parse_ply(const std::string& path, std::string_view bytes) { return PlyReader(path, bytes).read(); }

Model read_ply(const std::string& path) {
  FileText file = read_file(path);
  Model model;
  if (!file.error.empty()) return model.error = file.error, model;
  return parse_ply(path, file.text);
}

} // namespace moonshade::renderer
