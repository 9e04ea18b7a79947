#include "unparse.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace moonshade::test {
namespace {

using namespace syntax;

class Unparser {
public:
  std::string run(const Chunk& chunk) {
    block(*chunk.main->body);
    return std::move(out_);
  }

private:
  void put(std::string_view text) {
    out_ += text;
    out_ += ' ';
  }

  template <class... Args> void put_format(const char* format, Args... args) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, args...);
    put(buffer.data());
  }

  /// `self` of a method has no place where it could be renamed, and `_ENV` means something by its name.
  void put_local(const Local& local) {
    if (local.kind == LocalKind::Self || local.name == "_ENV")
      put(local.name);
    else
      put_format("L%u", local.id);
  }

  template <class List, class Put> void separated(const List& list, Put put_one) {
    bool is_first = true;
    for (const auto& element : list) {
      if (!is_first) put(",");
      is_first = false;
      put_one(element);
    }
  }
  void exprs(std::span<Expr* const> list) {
    separated(list, [&](const Expr* e) { expr(*e); });
  }
  void locals(std::span<Local* const> list) {
    separated(list, [&](const Local* local) { put_local(*local); });
  }

  void block(const Block& block) {
    // `then break` is compiled in a way of its own, which a semicolon between the two prevents.
    if (!block.stats.empty() && block.stats[0]->span.begin != block.span.begin) put(";");
    for (const Stat* stat : block.stats) {
      visit(*stat, [&](const auto& node) { write(node); });
      put(";");
    }
  }

  void expr(const Expr& expr) {
    visit(expr, [&](const auto& node) { write(node); });
  }
  void operand(const Expr& e) {
    const bool is_operation = e.kind == ExprKind::Binary || e.kind == ExprKind::Unary;
    if (is_operation) put("(");
    expr(e);
    if (is_operation) put(")");
  }

  void write(const NilExpr&) { put("nil"); }
  void write(const VarargExpr&) { put("..."); }
  void write(const ErrorExpr&) { put("<error>"); }
  void write(const BooleanExpr& n) { put(n.value ? "true" : "false"); }
  void write(const IntegerExpr& n) { put_format("0x%llx", static_cast<unsigned long long>(n.value)); }
  void write(const NumberExpr& n) { std::isinf(n.value) ? put("1e999") : put_format("%a", n.value); }
  void write(const StringExpr& n) {
    out_ += '"';
    for (const char c : n.value) {
      std::array<char, 8> buffer{};
      std::snprintf(buffer.data(), buffer.size(), "\\%03u", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out_ += buffer.data();
    }
    put("\"");
  }
  void write(const NameExpr& n) { n.local != nullptr ? put_local(*n.local) : put(n.name); }
  void write(const Function& n) {
    put("function");
    body(n, n.params);
  }
  void body(const Function& n, std::span<Local* const> params) {
    put("(");
    locals(params);
    if (n.is_vararg) put(params.empty() ? "..." : ", ...");
    put(")");
    block(*n.body);
    put("end");
  }
  void write(const IndexExpr& n) {
    expr(*n.object);
    put("[");
    expr(*n.key);
    put("]");
  }
  void arguments(std::span<Expr* const> args) {
    put("(");
    exprs(args);
    put(")");
  }
  void write(const CallExpr& n) {
    expr(*n.callee);
    arguments(n.args);
  }
  void write(const MethodCallExpr& n) {
    expr(*n.object);
    put(":");
    put(n.method.text);
    arguments(n.args);
  }
  void write(const ParenExpr& n) {
    put("(");
    expr(*n.inner);
    put(")");
  }
  void write(const UnaryExpr& n) {
    put(spelling_of(n.op));
    operand(*n.operand);
  }
  void write(const BinaryExpr& n) {
    operand(*n.left);
    put(spelling_of(n.op));
    operand(*n.right);
  }
  void write(const TableExpr& n) {
    put("{");
    separated(n.fields, [&](const TableField& field) {
      if (field.key != nullptr) {
        put("[");
        expr(*field.key);
        put("] =");
      }
      expr(*field.value);
    });
    put("}");
  }

  void write(const LocalStat& n) {
    put("local");
    separated(n.locals, [&](const Local* local) {
      put_local(*local);
      if (local->attrib == Attrib::Const) put("<const>");
      if (local->attrib == Attrib::Close) put("<close>");
    });
    if (!n.values.empty()) put("=");
    exprs(n.values);
  }
  void write(const AssignStat& n) {
    exprs(n.targets);
    put("=");
    exprs(n.values);
  }
  void write(const CallStat& n) { expr(*n.call); }
  void write(const DoStat& n) {
    put("do");
    block(*n.body);
    put("end");
  }
  void write(const WhileStat& n) {
    put("while");
    expr(*n.condition);
    put("do");
    block(*n.body);
    put("end");
  }
  void write(const RepeatStat& n) {
    put("repeat");
    block(*n.body);
    put("until");
    expr(*n.condition);
  }
  void write(const IfStat& n) {
    std::string_view keyword = "if";
    for (const IfClause& clause : n.clauses) {
      put(keyword);
      expr(*clause.condition);
      put("then");
      block(*clause.body);
      keyword = "elseif";
    }
    if (n.else_body != nullptr) {
      put("else");
      block(*n.else_body);
    }
    put("end");
  }
  void write(const NumericForStat& n) {
    put("for");
    put_local(*n.variable);
    put("=");
    expr(*n.start);
    put(",");
    expr(*n.limit);
    if (n.step != nullptr) {
      put(",");
      expr(*n.step);
    }
    put("do");
    block(*n.body);
    put("end");
  }
  void write(const GenericForStat& n) {
    put("for");
    locals(n.variables);
    put("in");
    exprs(n.values);
    put("do");
    block(*n.body);
    put("end");
  }
  void write(const FunctionStat& n) {
    put("function");
    function_name(*n.target, n.function->is_method);
    body(*n.function, n.function->params.subspan(n.function->is_method ? 1 : 0));
  }
  void function_name(const Expr& target, bool is_method) {
    const auto* index = try_as<IndexExpr>(&target);
    if (index == nullptr) return expr(target);
    function_name(*index->object, false);
    put(is_method ? ":" : ".");
    put(try_as<StringExpr>(index->key)->value);
  }
  void write(const LocalFunctionStat& n) {
    put("local function");
    put_local(*n.local);
    body(*n.function, n.function->params);
  }
  void write(const ReturnStat& n) {
    put("return");
    exprs(n.values);
  }
  void write(const BreakStat&) { put("break"); }
  void write(const GotoStat& n) {
    put("goto");
    put(n.label.text);
  }
  void write(const LabelStat& n) {
    put("::");
    put(n.label.text);
    put("::");
  }
  void write(const ErrorStat&) { put("<error>"); }

  std::string out_;
};

} // namespace

std::string unparse(const Chunk& chunk) { return Unparser().run(chunk); }

} // namespace moonshade::test
