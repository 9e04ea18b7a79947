// libFuzzer's mutator for Lua texts: most of its changes are of tokens and lines, so that many of its texts still parse
// and some still compile, where changed bytes nearly never do.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

using Tokens = std::vector<std::string>;
using Random = std::minstd_rand;

enum class Kind : uint8_t { Name, Number, Space, Other };

Kind kind_of(std::string_view token) {
  const auto first = static_cast<unsigned char>(token.front());
  if (std::isalpha(first) || first == '_') return Kind::Name;
  if (std::isdigit(first)) return Kind::Number;
  return std::isspace(first) ? Kind::Space : Kind::Other;
}

Tokens tokens_of(std::string_view text) {
  Tokens tokens;
  for (size_t at = 0; at < text.size();) {
    const Kind kind = kind_of(text.substr(at, 1));
    size_t end = at + 1;
    const auto continues = [&](char c) {
      const auto byte = static_cast<unsigned char>(c);
      if (kind == Kind::Name) return std::isalnum(byte) || c == '_';
      if (kind == Kind::Number) return std::isalnum(byte) || c == '.';
      return kind == Kind::Space && std::isspace(byte) && c != '\n';
    };
    while (end < text.size() && continues(text[end]))
      ++end;
    tokens.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return tokens;
}

size_t below(Random& random, size_t limit) { return limit == 0 ? 0 : random() % limit; }

template <size_t Size> const char* pick(Random& random, const std::array<const char*, Size>& list) {
  return list[below(random, Size)];
}

constexpr std::array<const char*, 20> kNumbers = {"0",
                                                  "1",
                                                  "2",
                                                  "3",
                                                  "-1",
                                                  "0.0",
                                                  "0.5",
                                                  "-0.0",
                                                  "1e308",
                                                  "1e-320",
                                                  "0x7fffffffffffffff",
                                                  "math.mininteger",
                                                  "63",
                                                  "64",
                                                  "1/0",
                                                  "0/0",
                                                  "9007199254740993",
                                                  "7",
                                                  "100",
                                                  "1.5"};
constexpr std::array<const char*, 26> kOperators = {"+",     "-",    "*",  "/",   "//",        "%", "^",  "==", "~=",
                                                    "<",     "<=",   ">",  ">=",  "&",         "|", "~",  "<<", ">>",
                                                    " and ", " or ", ".x", ".xy", ":length()", ",", "..", "#"};
constexpr std::array<const char*, 36> kNames = {
    "p",          "n",     "uv",        "time",   "frame",      "fw",        "backface", "vec2",
    "vec3",       "vec4",  "noise",     "perlin", "turbulence", "fbm",       "mix",      "clamp",
    "smoothstep", "min",   "max",       "floor",  "fract",      "mod",       "abs",      "hash",
    "dot",        "cross", "normalize", "length", "math.floor", "math.fmod", "math.max", "math.tointeger",
    "assert",     "not",   "true",      "false"};
constexpr std::array<const char*, 12> kStatements = {" if p.x > 0 then ",
                                                     " end ",
                                                     " else ",
                                                     " for i = 1, 5 do ",
                                                     " while p.y < 3 do ",
                                                     " repeat ",
                                                     " until p.x < 1 ",
                                                     " break ",
                                                     " return p.x ",
                                                     " local v = p.x ",
                                                     " do ",
                                                     " local function f(a) return a end "};

/// Another token of the same kind, often from the text itself.
std::string alternative(const Tokens& tokens, size_t at, Random& random) {
  const Kind kind = kind_of(tokens[at]);
  if (random() % 2 == 0)
    for (int attempt = 0; attempt < 8; ++attempt)
      if (const std::string& other = tokens[below(random, tokens.size())]; kind_of(other) == kind) return other;
  if (kind == Kind::Name) return pick(random, kNames);
  if (kind == Kind::Number) return pick(random, kNumbers);
  return kind == Kind::Other ? pick(random, kOperators) : pick(random, kStatements);
}

std::string wrapped(const std::string& token, const Tokens& tokens, Random& random) {
  switch (random() % 4) {
  case 0:
    return std::string(pick(random, kNames)) + "(" + token + ")";
  case 1:
    return "(" + token + pick(random, kOperators) + tokens[below(random, tokens.size())] + ")";
  case 2:
    return "(" + token + " > " + pick(random, kNumbers) + " and " + token + " or " + pick(random, kNumbers) + ")";
  default:
    return "(-" + token + ")";
  }
}

/// [begin, end) of a run of whole lines.
std::pair<size_t, size_t> lines_at(const Tokens& tokens, Random& random) {
  size_t begin = below(random, tokens.size()), end = begin;
  while (begin > 0 && tokens[begin - 1] != "\n")
    --begin;
  for (size_t count = 1 + below(random, 3); count > 0 && end < tokens.size(); --count) {
    while (end < tokens.size() && tokens[end] != "\n")
      ++end;
    end = std::min(end + 1, tokens.size());
  }
  return {begin, end};
}

void change(Tokens& tokens, Random& random) {
  const size_t at = below(random, tokens.size());
  const auto place = tokens.begin() + static_cast<std::ptrdiff_t>(at);
  switch (random() % 8) {
  case 0:
  case 1:
  case 2:
    tokens[at] = alternative(tokens, at, random);
    return;
  case 3:
    if (kind_of(tokens[at]) != Kind::Space && kind_of(tokens[at]) != Kind::Other)
      tokens[at] = wrapped(tokens[at], tokens, random);
    return;
  case 4:
    tokens.insert(place, random() % 2 == 0 ? pick(random, kStatements) : pick(random, kOperators));
    return;
  case 5:
    tokens.erase(place);
    return;
  default: {
    const auto [begin, end] = lines_at(tokens, random);
    const Tokens lines(tokens.begin() + static_cast<std::ptrdiff_t>(begin),
                       tokens.begin() + static_cast<std::ptrdiff_t>(end));
    if (random() % 3 == 0)
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(begin),
                   tokens.begin() + static_cast<std::ptrdiff_t>(end));
    else
      tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(lines_at(tokens, random).first), lines.begin(),
                    lines.end());
  }
  }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  Random random(seed + 1);
  if (size == 0 || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Tokens tokens = tokens_of({reinterpret_cast<const char*>(data), size});
  for (size_t changes = 1 + below(random, 4); changes > 0 && !tokens.empty(); --changes)
    change(tokens, random);
  std::string text;
  for (const std::string& token : tokens)
    text += token;
  if (text.size() > max_size) text.resize(max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
