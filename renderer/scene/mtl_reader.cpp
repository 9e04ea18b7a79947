// How MTL's numbers become ours: Kd color; Ks = 0 no specular reflection (ior 1); Ns the roughness with the same width
// of highlight (alpha^2 = 2 / (Ns + 2), roughness = sqrt(alpha)), where there is no Pr; Ke emission; Pr and Pm
// roughness and metallic; d, or else 1 - Tr, opacity. An image's factor is the number beside it, as the format has it,
// or 1 where that is missing or 0: many programs write zeros beside an image.
#include "renderer/scene/mtl_reader.h"

#include <charconv>
#include <map>
#include <optional>
#include <sstream>

namespace moonshade::renderer {

namespace {

class MtlParser {
public:
  MtlParser(const std::string& path, const Folders& folders) : path_(path), folders_(folders) {}

  MtlReading parse(std::string_view text) {
    size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    while (at < text.size() && reading_.error.empty()) {
      size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      ++line_number_;
      line(text.substr(at, end - at));
      at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    }
    finish_material();
    return std::move(reading_);
  }

private:
  std::string place() const { return path_ + ":" + std::to_string(line_number_); }
  void fail(const std::string& message) { reading_.error = place() + ": " + message; }
  void warn(const std::string& message) {
    if (reading_.warnings.size() < 20) reading_.warnings.push_back(place() + ": " + message);
  }
  Material& material() { return reading_.materials.back(); }
  std::optional<Vec3>& value(Slot slot) { return material().values[size_t(slot)]; }

  void line(std::string_view text);
  bool shader_statement(const std::string& key, std::istringstream& words);
  void name_shader(const std::string& key, const std::string& file);
  bool numbers(std::istringstream& words, Vec3& v, bool allow_one);
  void color(Slot slot, std::istringstream& words);
  void scalar(const std::string& key, std::istringstream& words);
  std::optional<SlotImage> image(const std::string& key, std::istringstream& words);
  void slot_image(const std::string& key, Slot slot, std::istringstream& words);
  void bump_image(const std::string& key, BumpImage::Kind kind, std::istringstream& words);
  void finish_material();

  std::string path_;
  const Folders& folders_;
  MtlReading reading_;
  size_t line_number_ = 0;
  // Of the material in hand.
  std::optional<Vec3> roughness_;               ///< as Pr states it
  std::optional<float> opacity_, transparency_; ///< as d and Tr do
};

std::string trimmed(const std::string& text) {
  size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
}

std::string lower_case(std::string text) {
  for (char& c : text)
    c = char(std::tolower((unsigned char)c));
  return text;
}

std::string rest(std::istringstream& words) {
  std::string text;
  std::getline(words, text);
  return trimmed(text);
}

void MtlParser::name_shader(const std::string& key, const std::string& file) {
  ResolvedPath resolved = folders_.resolve(folder_of(path_), file);
  // A file of the whole name wins over a comment.
  size_t comment = file.find(" #");
  if (!resolved.error.empty() && comment != std::string::npos)
    resolved = folders_.resolve(folder_of(path_), trimmed(file.substr(0, comment)));
  if (!resolved.error.empty()) return fail(key + "_shader: " + resolved.error);
  if (key == "texture") material().shaders[size_t(Slot::Color)] = resolved.path;
  if (key == "reflect") material().shaders[size_t(Slot::Reflectance)] = resolved.path;
  if (key == "bump") material().height_shader = resolved.path;
}

/// `texture_shader FILE` or `texture shader FILE`, likewise bump and reflect.
bool MtlParser::shader_statement(const std::string& key, std::istringstream& words) {
  for (const char* name : {"texture", "bump", "reflect"}) {
    if (key == std::string(name) + "_shader") {
      std::string file = rest(words);
      if (file.empty())
        fail(key + " names no file");
      else
        name_shader(name, file);
      return true;
    }
    if (key != name) continue;
    std::streampos before = words.tellg();
    std::string second, file;
    words >> second;
    if (second == "shader") {
      file = rest(words);
      if (file.empty())
        fail(key + " shader names no file");
      else
        name_shader(name, file);
      return true;
    }
    words.clear();
    words.seekg(before);
  }
  return false;
}

bool MtlParser::numbers(std::istringstream& words, Vec3& v, bool allow_one) {
  std::string word;
  int count = 0;
  while (count < 3 && words >> word) {
    const char* begin = word.data() + (word[0] == '+');
    float number = 0;
    auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) return false;
    v[count++] = number;
  }
  if (count == 1 && allow_one) v = Vec3(v.x);
  return count == 3 || (count == 1 && allow_one);
}

void MtlParser::color(Slot slot, std::istringstream& words) {
  Vec3 v(0);
  if (numbers(words, v, true))
    value(slot) = glm::max(v, Vec3(0));
  else
    warn("no colour of three numbers; ignored");
}

void MtlParser::scalar(const std::string& key, std::istringstream& words) {
  Vec3 v(0);
  std::string first;
  words >> first;
  std::istringstream word(first == "-halo" ? (words >> first, first) : first);
  if (!numbers(word, v, true)) return warn("'" + key + "' without a number; ignored");
  if (key == "Ns")
    value(Slot::Roughness) = Vec3(std::sqrt(std::sqrt(2.0f / (std::max(v.x, 0.0f) + 2.0f))));
  else if (key == "Pr")
    roughness_ = v;
  else if (key == "Pm")
    value(Slot::Metallic) = v;
  else if (key == "Ni" && v.x >= 1)
    value(Slot::Ior) = v;
  else if (key == "d")
    opacity_ = v.x;
  else if (key == "Tr")
    transparency_ = v.x;
}

/// How many words follow an option of an image; of those of vectors one to three numbers.
int words_of_option(const std::string& option) {
  static const std::map<std::string, int> kCounts = {
      {"-blendu", 1},  {"-blendv", 1}, {"-boost", 1},  {"-bm", 1},   {"-cc", 1}, {"-clamp", 1}, {"-colorspace", 1},
      {"-imfchan", 1}, {"-mm", 2},     {"-texres", 1}, {"-type", 1}, {"-o", 3},  {"-s", 3},     {"-t", 3}};
  const auto found = kCounts.find(option);
  return found == kCounts.end() ? -1 : found->second;
}

/// The first two of one to three numbers; `to` keeps what is not given.
void read_vector(std::istringstream& words, Vec2& to) {
  std::string word;
  for (int k = 0; k < 3; ++k) {
    const std::streampos before = words.tellg();
    float number = 0;
    if (!(words >> word)) return;
    const auto [end, error] = std::from_chars(word.data() + (word[0] == '+'), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) {
      words.clear(), words.seekg(before);
      return;
    }
    if (k < 2) to[k] = number;
  }
}

/// `map_Kd -s 2 2 1 -clamp on wood grain.png`; nothing, with a warning, where there is none. Its factor is that of -bm.
std::optional<SlotImage> MtlParser::image(const std::string& key, std::istringstream& words) {
  SlotImage image;
  std::string word;
  std::streampos name_at = words.tellg();
  for (; words >> word; name_at = words.tellg()) {
    const int count = words_of_option(word);
    if (count < 0) break;
    if (word == "-s")
      read_vector(words, image.scale);
    else if (word == "-o")
      read_vector(words, image.offset);
    else if (Vec2 first(0); word == "-t")
      read_vector(words, first);
    else if (first = Vec2(1); word == "-bm")
      read_vector(words, first), image.factor = Vec3(first.x);
    else
      for (int k = 0; k < count; ++k)
        words >> word;
  }
  words.clear(), words.seekg(name_at);
  image.name = rest(words);
  if (image.name.empty()) return warn("'" + key + "' names no image; ignored"), std::nullopt;
  ResolvedPath resolved = folders_.resolve_or_beside(folder_of(path_), image.name);
  const size_t comment = image.name.find(" #");
  if (!resolved.error.empty() && comment != std::string::npos) {
    image.name = trimmed(image.name.substr(0, comment));
    resolved = folders_.resolve_or_beside(folder_of(path_), image.name);
  }
  if (!resolved.error.empty())
    return warn("'" + key + "': " + resolved.error + "; drawn without this image"), std::nullopt;
  image.file = resolved.path;
  image.place = place();
  return image;
}

void MtlParser::slot_image(const std::string& key, Slot slot, std::istringstream& words) {
  std::optional<SlotImage> found = image(key, words);
  if (!found) return;
  found->part = slot == Slot::Opacity ? SlotImage::Part::Mask : SlotImage::Part::Red;
  material().images[size_t(slot)] = std::move(found);
}

/// Normals say more than heights.
void MtlParser::bump_image(const std::string& key, BumpImage::Kind kind, std::istringstream& words) {
  std::optional<SlotImage> found = image(key, words);
  auto& known = material().bump_image;
  if (!found || (known && known->kind == BumpImage::Kind::Normals && kind != known->kind)) return;
  known = BumpImage{std::move(*found), kind};
}

void MtlParser::finish_material() {
  if (reading_.materials.empty()) return;
  auto& images = material().images;
  if (images[size_t(Slot::Roughness)] || roughness_) value(Slot::Roughness) = roughness_;
  if (transparency_) value(Slot::Opacity) = Vec3(1 - *transparency_);
  if (opacity_) value(Slot::Opacity) = Vec3(*opacity_);
  for (size_t s = 0; s < kSlotCount; ++s) {
    auto& constant = material().values[s];
    std::optional<SlotImage>& image = images[s];
    if (!image) continue;
    if (constant && is_black(*constant)) constant.reset();
    image->factor = constant.value_or(Vec3(1));
  }
  roughness_.reset(), opacity_.reset(), transparency_.reset();
}

std::optional<Slot> slot_of_image(const std::string& key) {
  static const std::map<std::string, Slot> kSlots = {{"map_kd", Slot::Color},
                                                     {"map_ke", Slot::Emission},
                                                     {"map_d", Slot::Opacity},
                                                     {"map_pr", Slot::Roughness},
                                                     {"map_pm", Slot::Metallic}};
  const auto found = kSlots.find(key);
  return found == kSlots.end() ? std::nullopt : std::optional(found->second);
}

void MtlParser::line(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return fail("a zero byte: not a material file");
  std::istringstream words{std::string(text)};
  std::string key;
  if (!(words >> key) || key[0] == '#') return;
  if (key == "newmtl") {
    finish_material();
    reading_.materials.emplace_back();
    material().name = rest(words);
    material().place = place();
    return;
  }
  if (reading_.materials.empty()) return warn("'" + key + "' before the first newmtl; ignored");
  if (shader_statement(key, words)) return;
  Vec3 v(0);
  if (key == "Kd")
    color(Slot::Color, words);
  else if (key == "Ke")
    color(Slot::Emission, words);
  else if (key == "Ks" && numbers(words, v, true) && is_black(v))
    value(Slot::Ior) = Vec3(1);
  else if (key == "Ns" || key == "Ni" || key == "d" || key == "Tr" || key == "Pr" || key == "Pm")
    scalar(key, words);
  else if (const auto slot = slot_of_image(lower_case(key)))
    slot_image(key, *slot, words);
  else if (const std::string small = lower_case(key); small == "map_bump" || small == "bump")
    bump_image(key, BumpImage::Kind::ByLooks, words); // many programs write normals there
  else if (small == "norm" || small == "map_norm")
    bump_image(key, BumpImage::Kind::Normals, words);
  else if (key != "map_Ka" && (key.starts_with("map_") || key == "disp" || key == "refl"))
    warn("images of this kind ('" + key + "') are not shown; ignored");
  else if (std::string lower = lower_case(std::string(text)); lower.find("shader") != std::string::npos)
    warn("unknown statement '" + key + "'; shaders are named by texture_shader, bump_shader and reflect_shader");
}

} // namespace

MtlReading parse_mtl(const std::string& path, std::string_view text, const Folders& folders) {
  return MtlParser(path, folders).parse(text);
}

MtlReading read_mtl(const std::string& path, const Folders& folders) {
  FileText file = read_file(path, uint64_t(64) << 20);
  if (!file.error.empty()) return {{}, file.error, {}};
  return parse_mtl(path, file.text, folders);
}

} // namespace moonshade::renderer
