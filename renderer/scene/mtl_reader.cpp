// How MTL's numbers become ours: Kd color; Ks = 0 no specular reflection (ior 1); Ns the roughness with the same width
// of highlight (alpha^2 = 2 / (Ns + 2), roughness = sqrt(alpha)); Ke emission; Pr and Pm roughness and metallic.
#include "renderer/scene/mtl_reader.h"

#include <charconv>
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

  std::string path_;
  const Folders& folders_;
  MtlReading reading_;
  size_t line_number_ = 0;
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
    value(Slot::Roughness) = v;
  else if (key == "Pm")
    value(Slot::Metallic) = v;
  else if (key == "Ni" && v.x >= 1)
    value(Slot::Ior) = v;
  else if ((key == "d" && v.x < 1) || (key == "Tr" && v.x > 0))
    warn("transparency ('" + key + "') is not available yet; drawn opaque");
}

void MtlParser::line(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return fail("a zero byte: not a material file");
  std::istringstream words{std::string(text)};
  std::string key;
  if (!(words >> key) || key[0] == '#') return;
  if (key == "newmtl") {
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
  else if (key.starts_with("map_") || key == "bump" || key == "disp" || key == "norm")
    warn("images ('" + key + "') are not available yet; ignored");
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
