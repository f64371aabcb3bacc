#include "app/import/organ_look.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>
#include <string_view>

namespace palp
{
namespace
{

struct Known
{
  const char* word;
  OrganLook look;
};

constexpr const char* kArtery = "#d8654f";
constexpr const char* kVein = "#0097ce";
constexpr const char* kMass = "#90ee90";
constexpr const char* kLiver = "#dd8265";
constexpr const char* kBone = "#f1d691";
constexpr const char* kSkin = "#b17a65";

// the first whose word is in a name: a vessel of the liver is no liver
constexpr std::array kKnown{ Known{ "vessel", { "show", kArtery, nullptr } },
  Known{ "artery", { "show", kArtery, nullptr } },
  Known{ "arteries", { "show", kArtery, nullptr } }, Known{ "aorta", { "show", kArtery, nullptr } },
  Known{ "vein", { "show", kVein, nullptr } }, Known{ "cava", { "show", kVein, nullptr } },
  Known{ "metastasis", { "press", kMass, "metastasis" } },
  Known{ "metastases", { "press", kMass, "metastasis" } },
  Known{ "cholangiocarcinoma", { "press", kMass, "cholangiocarcinoma" } },
  Known{ "hemangioma", { "press", kMass, "hemangioma" } },
  Known{ "nodular hyperplasia", { "press", kMass, "nodular_hyperplasia" } },
  Known{ "adenoma", { "press", kMass, "adenoma" } }, Known{ "hcc", { "press", kMass, "hcc" } },
  Known{ "hepatocellular carcinoma", { "press", kMass, "hcc" } },
  Known{ "tumor", { "press", kMass, "hcc" } }, Known{ "tumour", { "press", kMass, "hcc" } },
  Known{ "lesion", { "press", kMass, "hcc" } }, Known{ "nodule", { "press", kMass, "hcc" } },
  Known{ "cyst", { "press", kMass, nullptr } },
  Known{ "cirrhosis", { "press", kLiver, "cirrhosis" } },
  Known{ "cirrhotic", { "press", kLiver, "cirrhosis" } },
  Known{ "fibrosis f 0", { "press", kLiver, "fibrosis_f0" } },
  Known{ "fibrosis f 1", { "press", kLiver, "fibrosis_f1" } },
  Known{ "fibrosis f 2", { "press", kLiver, "fibrosis_f2" } },
  Known{ "fibrosis f 3", { "press", kLiver, "fibrosis_f3" } },
  Known{ "fibrosis f 4", { "press", kLiver, "fibrosis_f4" } },
  Known{ "gallbladder", { "press", "#8b9662", nullptr } },
  Known{ "liver", { "press", kLiver, "healthy_liver" } },
  Known{ "kidney", { "press", "#b96653", nullptr } },
  Known{ "spleen", { "press", "#9d6ca2", nullptr } },
  Known{ "stomach", { "press", "#d88469", nullptr } },
  Known{ "pancreas", { "press", "#f9b46f", nullptr } },
  Known{ "skin", { "through", kSkin, "skin" } }, Known{ "fat", { "through", "#e6dc46", "fat" } },
  Known{ "bone", { "show", kBone, nullptr } }, Known{ "skull", { "show", kBone, nullptr } },
  Known{ "rib", { "show", kBone, nullptr } }, Known{ "vertebra", { "show", kBone, nullptr } },
  Known{ "spine", { "show", kBone, nullptr } }, Known{ "sacrum", { "show", kBone, nullptr } },
  Known{ "femur", { "show", kBone, nullptr } }, Known{ "body", { "through", kSkin, nullptr } } };

// words beside these that change no tissue; any other may: a tumor-free liver is no tumor
constexpr std::array kPlain{ "abdominal", "caudate", "epicardial", "healthy", "hepatic", "in",
  "intermuscular", "label", "large", "left", "lobe", "lower", "mask", "mesenteric", "normal", "of",
  "parenchyma", "pericardial", "perirenal", "primary", "quadrate", "right", "segment", "small",
  "subcutaneous", "the", "torso", "upper", "visceral", "whole" };

// of names that tell nothing, in turn: muscle, tissue, connective tissue, bone, mass
constexpr std::array kOthers{ "#c06858", "#80ae80", "#6fb8d2", kBone, kMass };

bool isAny(char letter, int (*kind)(int))
{
  return kind(static_cast<unsigned char>(letter)) != 0;
}

// with a space at each end: "LiverTumor_2" -> " liver tumor 2 "
std::string wordsOf(const std::string& name)
{
  std::string words = " ";
  char last = ' ';
  for (const char letter : name + " ")
  {
    const bool isNew = (isAny(letter, std::isupper) && isAny(last, std::islower)) ||
      isAny(letter, std::isdigit) != isAny(last, std::isdigit);
    const bool isWord = isAny(letter, std::isalnum);
    (isWord && !isNew) || words.back() == ' ' ? void() : words.push_back(' ');
    isWord ? words.push_back(static_cast<char>(std::tolower(letter))) : void();
    last = letter;
  }
  return words;
}

// one of them, or its plural: "liver" is not in "delivery"
bool hasWord(const std::string& words, const std::string& word)
{
  return std::ranges::any_of(std::array{ "", "s", "e", "es" },
    [&](const char* ending) { return words.find(" " + word + ending + " ") != words.npos; });
}

// whether a single word is a number, a letter, plain, or of one that is known
bool isClear(const std::string& word)
{
  const std::string alone = " " + word + " ";
  const auto isOf = [&](const Known& known)
  {
    std::istringstream parts(known.word);
    const std::istream_iterator<std::string> first(parts);
    return std::any_of(first, std::istream_iterator<std::string>(),
      [&](const std::string& part) { return hasWord(alone, part); });
  };
  return word.size() == 1 || isAny(word.front(), std::isdigit) ||
    std::ranges::any_of(kPlain, [&](const char* plain) { return hasWord(alone, plain); }) ||
    std::ranges::any_of(kKnown, isOf);
}

// The tissue of a name of which every word is clear, and all tell the same: of a liver's mass or
// disease that, of a fat liver none.
const char* tissueOf(const std::string& words)
{
  std::istringstream all(words);
  for (std::string word; all >> word;)
  {
    if (!isClear(word))
    {
      return nullptr;
    }
  }
  std::vector<OrganLook> looks;
  for (const Known& known : kKnown)
  {
    hasWord(words, known.word) ? looks.push_back(known.look) : void();
  }
  const auto text = [](const OrganLook& look)
  { return std::string_view(look.tissue != nullptr ? look.tissue : ""); };
  const bool isOfLiver = looks.size() > 1 && text(looks.back()) == "healthy_liver" &&
    (looks.front().color == kMass || looks.front().color == kLiver);
  isOfLiver ? looks.pop_back() : void();
  return std::ranges::all_of(
           looks, [&](const OrganLook& look) { return text(look) == text(looks.front()); })
    ? looks.front().tissue
    : nullptr;
}

} // namespace

OrganLook lookOf(const std::string& name)
{
  const std::string words = wordsOf(name);
  const auto found =
    std::ranges::find_if(kKnown, [&](const Known& known) { return hasWord(words, known.word); });
  return found == kKnown.end() ? OrganLook{ "press", kOthers.front(), nullptr }
                               : OrganLook{ found->look.role, found->look.color, tissueOf(words) };
}

std::vector<OrganLook> looksOf(const std::vector<std::string>& names)
{
  constexpr const char* kPressed = "press";
  std::vector<OrganLook> looks(names.size());
  std::ranges::transform(names, looks.begin(), lookOf);
  std::size_t others = 0;
  for (OrganLook& look : looks)
  {
    look.color = look.color == kOthers.front() ? kOthers[others++ % kOthers.size()] : look.color;
  }
  const auto isPressed = [](const OrganLook& look)
  { return std::string_view(look.role) == kPressed; };
  if (!looks.empty() && std::ranges::none_of(looks, isPressed))
  {
    looks.front().role = kPressed;
  }
  return looks;
}

} // namespace palp
