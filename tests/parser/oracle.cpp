// ms_parser_oracle: the parser and the reference implementation must give the same verdict, capacity aside, on a corpus
// and on generated inputs; what both accept must compile to the same code (unparse.h); literals must have the same
// value; every tree must keep its invariants.
//
//     ms_parser_oracle [--inputs=N] [--seed=S] [--corpus=DIR] [--keep-going]
//
// A corpus file is one input, or several parted by lines of "----"; files named valid*.lua hold inputs that the
// reference implementation accepts, invalid*.lua those that it refuses.
#include "check_tree.h"
#include "generator.h"
#include "lua_verdict.h"
#include "unparse.h"

#include "compiler/syntax/parser.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace moonshade::test {
namespace {

struct Options {
  uint64_t inputs = 50'000;
  uint64_t seed = 1;
  std::string corpus;
  bool keeps_going = false;
};

struct Counts {
  uint64_t compared = 0, accepted = 0, refused = 0, set_aside = 0, same_line = 0, same_code = 0, literals = 0,
           failures = 0;
};

class Oracle {
public:
  explicit Oracle(const Options& options) : options_(options), generator_(options.seed) {}

  int run() {
    if (!options_.corpus.empty()) run_corpus();
    for (uint64_t i = 0; i < options_.inputs && !must_stop(); ++i)
      run_generated(i);
    for (uint64_t i = 0; i < options_.inputs / 5 && !must_stop(); ++i)
      compare_literals();
    std::cout << counts_.compared << " inputs: " << counts_.accepted << " accepted by both (" << counts_.same_code
              << " of them compared as compiled code), " << counts_.refused << " refused by both (" << counts_.same_line
              << " of them first at the same line), " << counts_.set_aside << " set aside for capacity; "
              << counts_.literals << " literals; " << counts_.failures << " disagreements (seed " << options_.seed
              << ")\n";
    const bool is_vacuous =
        options_.inputs > 1000 && (counts_.accepted < options_.inputs / 10 || counts_.refused < options_.inputs / 10);
    if (is_vacuous) std::cout << "too few inputs of one verdict to mean anything\n";
    return counts_.failures != 0 || is_vacuous;
  }

private:
  bool must_stop() const { return counts_.failures != 0 && !options_.keeps_going; }

  void run_corpus() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(options_.corpus))
      paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    if (paths.empty()) fail("", "the corpus is empty");
    for (const auto& path : paths) {
      const bool is_valid = path.filename().string().starts_with("valid");
      for (const std::string& input : inputs_of(path)) {
        const Verdict expected = is_valid ? Verdict::Accepts : Verdict::Refuses;
        if (lua_.load(input).verdict != expected)
          fail(input, "the reference implementation says otherwise: " + path.string());
        compare(input);
        for (int i = 0; i < 20; ++i)
          compare(generator_.mutated(input));
        if (is_valid) valid_.push_back(input);
      }
    }
  }

  static std::vector<std::string> inputs_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream whole;
    whole << file.rdbuf();
    const std::string text = whole.str();
    constexpr std::string_view kSeparator = "\n----\n";
    std::vector<std::string> inputs;
    for (size_t begin = 0; begin <= text.size();) {
      const size_t end = std::min(text.find(kSeparator, begin), text.size());
      inputs.push_back(text.substr(begin, end - begin));
      begin = end + kSeparator.size();
    }
    return inputs;
  }

  void run_generated(uint64_t index) {
    switch (index % 6) {
    case 0:
      last_program_ = generator_.program();
      return compare(last_program_);
    case 1:
      return compare(generator_.token_stream());
    case 2:
      return compare(generator_.program_on_one_line());
    case 3:
      return compare(generator_.program_of_jumps());
    case 4:
      return compare(generator_.mutated(last_program_));
    default:
      if (valid_.empty()) return compare(generator_.mutated(last_program_));
      return compare(generator_.mutated(valid_[index / 6 % valid_.size()]));
    }
  }

  void compare(const std::string& input) {
    SourceSet sources;
    Arena arena;
    Diagnostics diagnostics;
    const FileId file = sources.add("t", input);
    const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
    const Lua::Result lua = lua_.load(input);
    ++counts_.compared;

    if (const std::string fault = check_tree(*chunk, input.size(), diagnostics.has_errors()); !fault.empty())
      fail(input, "the tree breaks an invariant: " + fault);
    if (lua.verdict == Verdict::OutOfCapacity || is_too_large(diagnostics)) {
      ++counts_.set_aside;
    } else if (diagnostics.has_errors() != (lua.verdict == Verdict::Refuses)) {
      fail(input, diagnostics.has_errors() ? "refused: " + diagnostics.sorted().front()->message
                                           : "accepted, but the reference implementation says: " + lua.message);
    } else if (lua.verdict == Verdict::Accepts) {
      ++counts_.accepted;
      compare_code(input, *chunk);
    } else {
      ++counts_.refused;
      counts_.same_line += sources.line_of(diagnostics.sorted().front()->span) == static_cast<uint32_t>(lua.line);
    }
  }

  /// The tree, written as Lua, compiles to the same code. Line numbers would differ, so only for inputs of one line.
  void compare_code(const std::string& input, const syntax::Chunk& chunk) {
    if (input.find_first_of("\r\n") != std::string::npos) return;
    ++counts_.same_code;
    const std::string written = unparse(chunk);
    if (lua_.code(input) != lua_.code(written)) fail(input, "the tree means something else: " + written);
  }

  static bool is_too_large(const Diagnostics& diagnostics) {
    const auto sorted = diagnostics.sorted();
    return std::any_of(sorted.begin(), sorted.end(),
                       [](const Diagnostic* d) { return d->code == DiagnosticCode::TooLarge; });
  }

  void compare_literals() {
    const std::string literal = (literal_count_++ % 2 == 0) ? generator_.numeral() : generator_.string_literal();
    SourceSet sources;
    Arena arena;
    Diagnostics diagnostics;
    const FileId file = sources.add("t", "return " + literal);
    const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
    ++counts_.literals;
    Lua::Value ours;
    if (!diagnostics.has_errors()) ours = value_of(*chunk);
    if (!is_same(ours, lua_.literal(literal))) fail(literal, "the literal has another value");
  }

  static Lua::Value value_of(const syntax::Chunk& chunk) {
    const auto* stat = syntax::try_as<syntax::ReturnStat>(chunk.main->body->stats[0]);
    const syntax::Expr* expr = stat->values[0];
    if (const auto* integer = syntax::try_as<syntax::IntegerExpr>(expr)) return static_cast<long long>(integer->value);
    if (const auto* number = syntax::try_as<syntax::NumberExpr>(expr)) return number->value;
    if (const auto* string = syntax::try_as<syntax::StringExpr>(expr)) return std::string(string->value);
    return {};
  }

  static bool is_same(const Lua::Value& a, const Lua::Value& b) {
    const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    if (x != nullptr && y != nullptr) return std::memcmp(x, y, sizeof *x) == 0;
    return a == b;
  }

  void fail(const std::string& input, const std::string& what) {
    if (++counts_.failures <= 20) std::cout << "DISAGREEMENT: " << what << "\n<<<\n" << input << "\n>>>\n";
  }

  Options options_;
  Generator generator_;
  Lua lua_;
  Counts counts_;
  std::vector<std::string> valid_;
  uint64_t literal_count_ = 0;
  std::string last_program_ = "local a = 1";
};

bool read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    const auto value = [&](std::string_view name) { return arg.starts_with(name) ? argv[i] + name.size() : nullptr; };
    if (const char* inputs = value("--inputs="))
      options.inputs = std::strtoull(inputs, nullptr, 10);
    else if (const char* seed = value("--seed="))
      options.seed = std::strtoull(seed, nullptr, 10);
    else if (const char* corpus = value("--corpus="))
      options.corpus = corpus;
    else if (arg == "--keep-going")
      options.keeps_going = true;
    else
      return false;
  }
  return true;
}

} // namespace
} // namespace moonshade::test

int main(int argc, char** argv) {
  moonshade::test::Options options;
  if (!moonshade::test::read_options(argc, argv, options)) {
    std::cerr << "usage: ms_parser_oracle [--inputs=N] [--seed=S] [--corpus=DIR] [--keep-going]\n";
    return 2;
  }
  return moonshade::test::Oracle(options).run();
}
