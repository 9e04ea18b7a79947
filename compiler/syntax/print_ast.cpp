// The tree as text: one node a line, two blanks a level, what is particular to the node behind its name. Parts of a
// statement that could be mixed up stand under a line of their own in lower case ("condition", "else").
#include "compiler/syntax/ast.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>

namespace moonshade::syntax {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (byte >= 0x20 && byte < 0x7F) {
      result += c;
    } else {
      std::array<char, 8> buffer{};
      std::snprintf(buffer.data(), buffer.size(), "\\%03u", static_cast<unsigned>(byte));
      result += buffer.data();
    }
  }
  return result + '"';
}

/// The shortest text that reads back as the same float, and always as a float.
std::string number_text(double value) {
  if (std::isinf(value)) return "1e999";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string local_text(const Local& local) {
  std::string text(local.name);
  if (local.attrib == Attrib::Const) text += " <const>";
  if (local.attrib == Attrib::Close) text += " <close>";
  return text + " #" + std::to_string(local.id);
}

std::string locals_text(std::span<Local* const> locals) {
  std::string text;
  for (const Local* local : locals)
    text += (text.empty() ? "" : ", ") + local_text(*local);
  return text;
}

class AstPrinter {
public:
  explicit AstPrinter(std::ostream& out) : out_(out) {}

  void print(const Chunk& chunk) {
    line("Chunk");
    block(*chunk.main->body);
  }

private:
  /// A line, and everything below it one level in, for as long as the Level lives.
  struct Level {
    explicit Level(AstPrinter& p) : printer(p) { ++printer.depth_; }
    ~Level() { --printer.depth_; }
    AstPrinter& printer;
  };

  void line(std::string_view name, std::string_view rest = {}) {
    out_ << std::string(2 * depth_, ' ') << name;
    if (!rest.empty()) out_ << ' ' << rest;
    out_ << '\n';
  }

  void block(const Block& block) {
    Level level(*this);
    for (const Stat* stat : block.stats)
      print(*stat);
  }
  void titled(std::string_view title, const Block& body) {
    Level level(*this);
    line(title);
    block(body);
  }
  void titled(std::string_view title, std::span<Expr* const> exprs) {
    Level level(*this);
    if (exprs.empty()) return;
    line(title);
    children(exprs);
  }
  void titled(std::string_view title, const Expr& expr) {
    Level level(*this);
    line(title);
    child(expr);
  }
  void children(std::span<Expr* const> exprs) {
    for (const Expr* expr : exprs)
      child(*expr);
  }
  void child(const Expr& expr) {
    Level level(*this);
    print(expr);
  }
  void print(const Expr& expr) {
    visit(expr, [&](const auto& node) { write(name_of(expr.kind), node); });
  }
  void print(const Stat& stat) {
    visit(stat, [&](const auto& node) { write(name_of(stat.kind), node); });
  }

  void write(std::string_view name, const NilExpr&) { line(name); }
  void write(std::string_view name, const VarargExpr&) { line(name); }
  void write(std::string_view name, const ErrorExpr&) { line(name); }
  void write(std::string_view name, const BooleanExpr& node) { line(name, node.value ? "true" : "false"); }
  void write(std::string_view name, const IntegerExpr& node) { line(name, std::to_string(node.value)); }
  void write(std::string_view name, const NumberExpr& node) { line(name, number_text(node.value)); }
  void write(std::string_view name, const StringExpr& node) { line(name, quoted(node.value)); }
  void write(std::string_view name, const NameExpr& node) {
    std::string text(node.name);
    if (node.local != nullptr)
      text += (node.is_upvalue ? " upvalue #" : " local #") + std::to_string(node.local->id);
    else
      text += node.environment != nullptr ? " global in #" + std::to_string(node.environment->id) : " global";
    line(name, text);
  }
  void write(std::string_view name, const Function& node) {
    std::string text = node.name.empty() ? "" : std::string(node.name) + " ";
    text += "(" + locals_text(node.params);
    if (node.is_vararg) text += node.params.empty() ? "..." : ", ...";
    line(name, text + ")");
    block(*node.body);
  }
  void write(std::string_view name, const IndexExpr& node) {
    line(name, node.is_dotted ? "dotted" : "");
    child(*node.object);
    child(*node.key);
  }
  void write(std::string_view name, const CallExpr& node) {
    line(name);
    child(*node.callee);
    titled("args", node.args);
  }
  void write(std::string_view name, const MethodCallExpr& node) {
    line(name, node.method.text);
    child(*node.object);
    titled("args", node.args);
  }
  void write(std::string_view name, const ParenExpr& node) {
    line(name);
    child(*node.inner);
  }
  void write(std::string_view name, const UnaryExpr& node) {
    line(name, spelling_of(node.op));
    child(*node.operand);
  }
  void write(std::string_view name, const BinaryExpr& node) {
    line(name, spelling_of(node.op));
    child(*node.left);
    child(*node.right);
  }
  void write(std::string_view name, const TableExpr& node) {
    line(name);
    Level level(*this);
    for (const TableField& field : node.fields) {
      const auto* named = field.kind == FieldKind::Named ? try_as<StringExpr>(field.key) : nullptr;
      line("field", named != nullptr ? named->value : field.kind == FieldKind::Keyed ? "keyed" : "");
      if (field.kind == FieldKind::Keyed) child(*field.key);
      child(*field.value);
    }
  }

  void write(std::string_view name, const LocalStat& node) {
    line(name, locals_text(node.locals));
    children(node.values);
  }
  void write(std::string_view name, const AssignStat& node) {
    line(name);
    titled("targets", node.targets);
    titled("values", node.values);
  }
  void write(std::string_view name, const CallStat& node) {
    line(name);
    child(*node.call);
  }
  void write(std::string_view name, const DoStat& node) {
    line(name);
    block(*node.body);
  }
  void write(std::string_view name, const WhileStat& node) {
    line(name);
    titled("condition", *node.condition);
    titled("body", *node.body);
  }
  void write(std::string_view name, const RepeatStat& node) {
    line(name);
    titled("body", *node.body);
    titled("condition", *node.condition);
  }
  void write(std::string_view name, const IfStat& node) {
    line(name);
    for (const IfClause& clause : node.clauses) {
      titled("condition", *clause.condition);
      titled("then", *clause.body);
    }
    if (node.else_body != nullptr) titled("else", *node.else_body);
  }
  void write(std::string_view name, const NumericForStat& node) {
    line(name, local_text(*node.variable));
    titled("start", *node.start);
    titled("limit", *node.limit);
    if (node.step != nullptr) titled("step", *node.step);
    titled("body", *node.body);
  }
  void write(std::string_view name, const GenericForStat& node) {
    line(name, locals_text(node.variables));
    titled("in", node.values);
    titled("body", *node.body);
  }
  void write(std::string_view name, const FunctionStat& node) {
    line(name);
    child(*node.target);
    child(*node.function);
  }
  void write(std::string_view name, const LocalFunctionStat& node) {
    line(name, local_text(*node.local));
    child(*node.function);
  }
  void write(std::string_view name, const ReturnStat& node) {
    line(name);
    children(node.values);
  }
  void write(std::string_view name, const BreakStat&) { line(name); }
  void write(std::string_view name, const GotoStat& node) { line(name, node.label.text); }
  void write(std::string_view name, const LabelStat& node) { line(name, node.label.text); }
  void write(std::string_view name, const ErrorStat&) { line(name); }

  std::ostream& out_;
  size_t depth_ = 0;
};

} // namespace

void print_ast(const Chunk& chunk, std::ostream& out) { AstPrinter(out).print(chunk); }

} // namespace moonshade::syntax
