// Mutations of files of lists and parameters as such: nodes are copied, removed, moved and renamed, values replaced, and what the target declares is
// added where it may stand.

#include <libxml/parser.h>
#include <libxml/tree.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fuzz_targets.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using mortise::ListRecord;
using mortise::ParameterRecord;
using Random = std::minstd_rand;
using Document = std::unique_ptr<xmlDoc, void (*)(xmlDoc*)>;

const xmlChar* xml(const std::string& text) { return reinterpret_cast<const xmlChar*>(text.c_str()); }

template <class Container>
const auto& one_of(const Container& all, Random& random) {
  return all[random() % all.size()];
}

std::string nested(const std::string& open, const std::string& inside, const std::string& close, int depth) {
  std::string text;
  for (int n = 0; n < depth; ++n) text += open;
  text += inside;
  for (int n = 0; n < depth; ++n) text += close;
  return text;
}

const std::vector<std::string>& interesting_values() {
  static const std::vector<std::string> values{"",
                                               " ",
                                               ",",
                                               "nan",
                                               "inf",
                                               "0",
                                               "-0",
                                               "1",
                                               "-1",
                                               "0.5",
                                               "1e308",
                                               "-1e308",
                                               "1e308*10",
                                               "1e-320",
                                               "1e400",
                                               "0x10",
                                               "2147483647",
                                               "2147483648",
                                               "-2147483649",
                                               "1e19",
                                               "1, 2",
                                               "1, 2, 3",
                                               "1, , 2",
                                               "0, 0, 0, 0",
                                               "true",
                                               "false",
                                               "t",
                                               "1/t",
                                               "x*y - z",
                                               "sqrt(-1)",
                                               "x = 1",
                                               "sin(",
                                               "min()",
                                               "sum(1, 2",
                                               "\"",
                                               "<&>'",
                                               "\xc3\xa4\xe2\x82\xac",
                                               "a/b",
                                               "/",
                                               "..",
                                               "richardson",
                                               std::string(5000, 'a'),
                                               nested("(", "1", ")", 100),
                                               nested("(", "1", ")", 3000),
                                               nested("-", "1", "", 3000),
                                               nested("1+", "1", "", 3000),
                                               nested("sin(", "t", ")", 1000),
                                               nested("1?", "1", ":2", 500)};
  return values;
}

std::string attribute(xmlNode* node, const char* name) {
  const std::unique_ptr<xmlChar, void (*)(void*)> value(xmlGetProp(node, xml(name)), xmlFree);
  return value ? reinterpret_cast<const char*>(value.get()) : "";
}

void set(xmlNode* node, const char* name, const std::string& value) { xmlSetProp(node, xml(name), xml(value)); }

bool is_list(const xmlNode* node) { return std::strcmp(reinterpret_cast<const char*>(node->name), "ParameterList") == 0; }

void collect(xmlNode* node, std::vector<xmlNode*>& all) {
  for (; node != nullptr; node = node->next)
    if (node->type == XML_ELEMENT_NODE) {
      all.push_back(node);
      collect(node->children, all);
    }
}

class Mutation {
 public:
  Mutation(xmlDoc* document, unsigned seed) : random_(seed), root_(xmlDocGetRootElement(document)) { look_again(); }

  void apply() {
    switch (random_() % 9) {
      case 0:
        return copy(one_of(all_, random_));
      case 1:
        return remove();
      case 2:
        return move();
      case 3:
        return set(one_of(all_, random_), "name", any_name());
      case 4:
        return set(one_of(all_, random_), "type", one_of(std::vector<std::string>{"double", "int", "bool", "string", "", "list"}, random_));
      case 5:
        return add_declared();
      default:
        return change_value();
    }
  }

  /// Puts a part of another document somewhere.
  void take_from(xmlDoc* other) {
    std::vector<xmlNode*> theirs;
    collect(xmlDocGetRootElement(other), theirs);
    if (!theirs.empty()) xmlAddChild(any_list(), xmlDocCopyNode(one_of(theirs, random_), root_->doc, 1));
  }

 private:
  void look_again() {
    all_.clear();
    collect(root_, all_);
  }

  xmlNode* any_list() {
    std::vector<xmlNode*> lists;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(lists), is_list);
    return lists.empty() ? root_ : one_of(lists, random_);
  }

  std::string any_name() {
    if (random_() % 4 == 0) return one_of(interesting_values(), random_);
    const ListRecord& list = any_declared(declarations());
    if (random_() % 2 == 0 && !list.parameters.empty()) return one_of(list.parameters, random_).name;
    return random_() % 2 == 0 && !list.lists.empty() ? one_of(list.lists, random_).name : attribute(one_of(all_, random_), "name");
  }

  static const ListRecord& declarations() {
    static const ListRecord tree = mortise::fuzz::target(MORTISE_FUZZ_TARGET).declarations();
    return tree;
  }

  const ListRecord& any_declared(const ListRecord& tree) {
    const std::size_t below = tree.lists.size() + tree.kinds.size(), chosen = random_() % (below + 1);
    if (chosen < tree.lists.size()) return any_declared(tree.lists[chosen]);
    return chosen < below ? any_declared(tree.kinds[chosen - tree.lists.size()].second) : tree;
  }

  /// Declarations for a list of the document; of its kinds that which it names, if it names one.
  const ListRecord* declared(xmlNode* list) {
    if (list == root_ || list->parent == nullptr) return &declarations();
    const ListRecord* around = declared(list->parent);
    if (around == nullptr) return nullptr;
    const std::string name = attribute(list, "name");
    const ListRecord* found = mortise::find_list(*around, name);
    if (found == nullptr) return nullptr;
    for (xmlNode* child = list->children; child != nullptr; child = child->next)
      if (child->type == XML_ELEMENT_NODE && attribute(child, "name") == "type" && random_() % 2 == 0)
        for (const auto& [kind, record] : found->kinds)
          if (kind == attribute(child, "value")) return &record;
    return found;
  }

  void copy(xmlNode* node) {
    xmlNode* twin = xmlCopyNode(node, 1);
    if (random_() % 2 == 0) set(twin, "name", attribute(node, "name") + "2");
    xmlAddNextSibling(node, twin);
  }

  void remove() {
    xmlNode* node = one_of(all_, random_);
    if (node == root_) return;
    xmlUnlinkNode(node);
    xmlFreeNode(node);
    look_again();
  }

  void move() {
    xmlNode *node = one_of(all_, random_), *to = any_list();
    for (xmlNode* around = to; around != nullptr; around = around->parent)
      if (around == node) return;
    xmlUnlinkNode(node);
    xmlAddChild(to, node);
  }

  std::string any_value(const ParameterRecord* one) {
    const auto choice = random_() % 4;
    if (one != nullptr && !one->choices.empty() && choice < 3) return one_of(one->choices, random_);
    if (one != nullptr && !one->value.empty() && choice == 0) return one->value;
    if (choice == 1) return attribute(one_of(all_, random_), "name");
    if (choice == 2) return attribute(one_of(all_, random_), "value");
    return one_of(interesting_values(), random_);
  }

  void change_value() {
    xmlNode* node = one_of(all_, random_);
    if (is_list(node)) return add_declared();
    const ListRecord* around = node->parent == nullptr ? nullptr : declared(node->parent);
    const ParameterRecord* known = nullptr;
    if (around != nullptr)
      for (const ParameterRecord& one : around->parameters)
        if (one.name == attribute(node, "name")) known = &one;
    set(node, "value", any_value(known));
  }

  void add_declared() {
    xmlNode* list = any_list();
    const ListRecord* known = declared(list);
    if (known == nullptr) known = &any_declared(declarations());
    const bool as_list = !known->lists.empty() && (known->parameters.empty() || random_() % 2 == 0);
    if (!as_list && known->parameters.empty()) return;
    xmlNode* added = xmlNewChild(list, nullptr, xml(as_list ? "ParameterList" : "Parameter"), nullptr);
    if (as_list) return set(added, "name", one_of(known->lists, random_).name);
    const ParameterRecord& one = one_of(known->parameters, random_);
    set(added, "name", one.name);
    set(added, "type", one.type());
    set(added, "value", any_value(&one));
  }

  Random random_;
  xmlNode* root_;
  std::vector<xmlNode*> all_;
};

Document parsed(const std::uint8_t* data, std::size_t size) {
  return {xmlReadMemory(reinterpret_cast<const char*>(data), static_cast<int>(size), "", nullptr,
                        XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOBLANKS),
          xmlFreeDoc};
}

/// The size of the document as bytes in `data`; 0 if it does not fit.
std::size_t written(xmlDoc* document, std::uint8_t* data, std::size_t max_size) {
  xmlChar* text = nullptr;
  int size = 0;
  xmlDocDumpMemory(document, &text, &size);
  const std::unique_ptr<xmlChar, void (*)(void*)> owned(text, xmlFree);
  if (text == nullptr || static_cast<std::size_t>(size) > max_size) return 0;
  std::memcpy(data, text, static_cast<std::size_t>(size));
  return static_cast<std::size_t>(size);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  Random random(seed);
  const Document document = parsed(data, size);
  // Bytes as such are for the reader of XML itself.
  if (!document || random() % 16 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Mutation mutation(document.get(), static_cast<unsigned>(random()));
  for (auto changes = 1 + random() % 4; changes > 0; --changes) mutation.apply();
  const std::size_t bytes = written(document.get(), data, max_size);
  return bytes > 0 ? bytes : LLVMFuzzerMutate(data, size, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data, std::size_t size, const std::uint8_t* other, std::size_t other_size,
                                                 std::uint8_t* out, std::size_t max_size, unsigned seed) {
  const Document document = parsed(data, size), from = parsed(other, other_size);
  if (!document || !from) return 0;
  Mutation(document.get(), seed).take_from(from.get());
  return written(document.get(), out, max_size);
}
