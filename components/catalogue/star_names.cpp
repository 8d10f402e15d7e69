#include "components/catalogue/star_names.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <span>

namespace omma {
namespace {

struct NamedStar {
  std::uint16_t hr;
  std::string_view text;
};

constexpr NamedStar kProperNames[] = {
    // clang-format off
    {15, "Alpheratz"},
    {21, "Caph"},
    {39, "Algenib"},
    {99, "Ankaa"},
    {153, "Fulu"},
    {168, "Schedar"},
    {188, "Diphda"},
    {219, "Achird"},
    {337, "Mirach"},
    {403, "Ruchbah"},
    {424, "Polaris"},
    {437, "Alpherg"},
    {464, "Nembus"},
    {472, "Achernar"},
    {539, "Baten Kaitos"},
    {542, "Segin"},
    {544, "Mothallah"},
    {553, "Sheratan"},
    {596, "Alrescha"},
    {603, "Almach"},
    {617, "Hamal"},
    {681, "Mira"},
    {804, "Kaffaljidhma"},
    {834, "Miram"},
    {838, "Bharani"},
    {874, "Azha"},
    {897, "Acamar"},
    {911, "Menkar"},
    {936, "Algol"},
    {941, "Misam"},
    {963, "Dalim"},
    {1017, "Mirfak"},
    {1084, "Ran"},
    {1131, "Atik"},
    {1142, "Electra"},
    {1145, "Taygeta"},
    {1149, "Maia"},
    {1156, "Merope"},
    {1165, "Alcyone"},
    {1178, "Atlas"},
    {1228, "Menkib"},
    {1231, "Zaurak"},
    {1298, "Beid"},
    {1325, "Keid"},
    {1346, "Prima Hyadum"},
    {1373, "Secunda Hyadum"},
    {1393, "Beemim"},
    {1409, "Ain"},
    {1412, "Chamukuy"},
    {1457, "Aldebaran"},
    {1481, "Sceptrum"},
    {1577, "Hassaleh"},
    {1605, "Almaaz"},
    {1612, "Saclateni"},
    {1641, "Haedus"},
    {1666, "Cursa"},
    {1708, "Capella"},
    {1713, "Rigel"},
    {1790, "Bellatrix"},
    {1791, "Elnath"},
    {1829, "Nihal"},
    {1852, "Mintaka"},
    {1865, "Arneb"},
    {1879, "Meissa"},
    {1899, "Hatysa"},
    {1903, "Alnilam"},
    {1948, "Alnitak"},
    {1956, "Phact"},
    {2004, "Saiph"},
    {2061, "Betelgeuse"},
    {2088, "Menkalinan"},
    {2095, "Mahasim"},
    {2216, "Propus"},
    {2282, "Furud"},
    {2286, "Tejat"},
    {2294, "Mirzam"},
    {2326, "Canopus"},
    {2421, "Alhena"},
    {2473, "Mebsuta"},
    {2484, "Alzirr"},
    {2491, "Sirius"},
    {2618, "Adhara"},
    {2650, "Mekbuda"},
    {2693, "Wezen"},
    {2777, "Wasat"},
    {2827, "Aludra"},
    {2845, "Gomeisa"},
    {2891, "Castor"},
    {2943, "Procyon"},
    {2990, "Pollux"},
    {3045, "Azmidi"},
    {3165, "Naos"},
    {3185, "Tureis"},
    {3275, "Alsciaukat"},
    {3307, "Avior"},
    {3323, "Muscida"},
    {3449, "Asellus Borealis"},
    {3461, "Asellus Australis"},
    {3482, "Ashlesha"},
    {3485, "Alsephina"},
    {3569, "Talitha"},
    {3634, "Suhail"},
    {3685, "Miaplacidus"},
    {3699, "Aspidiske"},
    {3734, "Markeb"},
    {3748, "Alphard"},
    {3905, "Rasalas"},
    {3982, "Regulus"},
    {4031, "Adhafera"},
    {4033, "Tania Borealis"},
    {4057, "Algieba"},
    {4069, "Tania Australis"},
    {4247, "Praecipua"},
    {4287, "Alkes"},
    {4295, "Merak"},
    {4301, "Dubhe"},
    {4357, "Zosma"},
    {4359, "Chertan"},
    {4375, "Alula Australis"},
    {4377, "Alula Borealis"},
    {4434, "Giausar"},
    {4534, "Denebola"},
    {4540, "Zavijava"},
    {4554, "Phecda"},
    {4623, "Alchiba"},
    {4660, "Megrez"},
    {4662, "Gienah"},
    {4700, "Ginan"},
    {4730, "Acrux"},
    {4757, "Algorab"},
    {4763, "Gacrux"},
    {4785, "Chara"},
    {4786, "Kraz"},
    {4825, "Porrima"},
    {4853, "Mimosa"},
    {4905, "Alioth"},
    {4910, "Minelauva"},
    {4915, "Cor Caroli"},
    {4932, "Vindemiatrix"},
    {5054, "Mizar"},
    {5056, "Spica"},
    {5062, "Alcor"},
    {5107, "Heze"},
    {5191, "Alkaid"},
    {5235, "Muphrid"},
    {5267, "Hadar"},
    {5288, "Menkent"},
    {5291, "Thuban"},
    {5340, "Arcturus"},
    {5435, "Seginus"},
    {5459, "Rigil Kentaurus"},
    {5460, "Toliman"},
    {5506, "Izar"},
    {5531, "Zubenelgenubi"},
    {5563, "Kochab"},
    {5602, "Nekkar"},
    {5603, "Brachium"},
    {5685, "Zubeneschamali"},
    {5735, "Pherkad"},
    {5744, "Edasich"},
    {5747, "Nusakan"},
    {5793, "Alphecca"},
    {5854, "Unukalhai"},
    {5928, "Iklil"},
    {5944, "Fang"},
    {5953, "Dschubba"},
    {5984, "Acrab"},
    {6056, "Yed Prior"},
    {6075, "Yed Posterior"},
    {6084, "Alniyat"},
    {6132, "Athebyne"},
    {6134, "Antares"},
    {6148, "Kornephoros"},
    {6149, "Marfik"},
    {6217, "Atria"},
    {6241, "Larawag"},
    {6252, "Pipirima"},
    {6378, "Sabik"},
    {6396, "Aldhibah"},
    {6406, "Rasalgethi"},
    {6410, "Sarin"},
    {6508, "Lesath"},
    {6527, "Shaula"},
    {6536, "Rastaban"},
    {6553, "Sargas"},
    {6556, "Rasalhague"},
    {6603, "Cebalrai"},
    {6630, "Fuyue"},
    {6688, "Grumium"},
    {6705, "Eltanin"},
    {6746, "Alnasl"},
    {6812, "Polis"},
    {6859, "Kaus Media"},
    {6879, "Kaus Australis"},
    {6913, "Kaus Borealis"},
    {7001, "Vega"},
    {7106, "Sheliak"},
    {7121, "Nunki"},
    {7178, "Sulafat"},
    {7194, "Ascella"},
    {7235, "Okab"},
    {7264, "Albaldah"},
    {7310, "Altais"},
    {7337, "Arkab Prior"},
    {7343, "Arkab Posterior"},
    {7348, "Rukbat"},
    {7417, "Albireo"},
    {7525, "Tarazed"},
    {7528, "Fawaris"},
    {7557, "Altair"},
    {7602, "Alshain"},
    {7754, "Algedi"},
    {7776, "Dabih"},
    {7790, "Peacock"},
    {7796, "Sadr"},
    {7852, "Aldulfin"},
    {7882, "Rotanev"},
    {7924, "Deneb"},
    {7949, "Aljanah"},
    {7950, "Albali"},
    {8131, "Kitalpha"},
    {8162, "Alderamin"},
    {8232, "Sadalsuud"},
    {8238, "Alfirk"},
    {8278, "Nashira"},
    {8308, "Enif"},
    {8322, "Deneb Algedi"},
    {8353, "Aldhanab"},
    {8414, "Sadalmelik"},
    {8425, "Alnair"},
    {8450, "Biham"},
    {8518, "Sadachbia"},
    {8634, "Homam"},
    {8650, "Matar"},
    {8684, "Sadalbari"},
    {8709, "Skat"},
    {8728, "Fomalhaut"},
    {8775, "Scheat"},
    {8781, "Markab"},
    {8974, "Errai"},
    // clang-format on
};

constexpr NamedStar kDesignations[] = {
#define STAR_DESIGNATION(hr, text) {hr, text},
#include "components/catalogue/star_designations_table.inc"
#undef STAR_DESIGNATION
};

std::string_view find(std::span<const NamedStar> table, std::uint16_t hr) noexcept {
  const auto* const end = table.data() + table.size();
  const auto* const at =
      std::lower_bound(table.data(), end, hr, [](const NamedStar& a, std::uint16_t b) { return a.hr < b; });
  return at != end && at->hr == hr ? at->text : std::string_view{};
}

/// Appends `text` without blanks to the `size` characters in `out`.
void append(std::array<char, 16>& out, std::size_t& size, std::string_view text) noexcept {
  for (const char c : text) {
    if (c != ' ' && size < out.size()) out[size++] = c;
  }
}

}  // namespace

std::string_view proper_name(std::uint16_t hr) noexcept {
  return find(kProperNames, hr);
}

Name star_designation(std::uint16_t hr) noexcept {
  std::array<char, 16> text{};
  std::size_t size = 0;
  const std::string_view printed = find(kDesignations, hr);  // Flamsteed 3, Bayer 3, index 1, constellation 3
  if (printed.size() == 10) {
    const std::string_view flamsteed = printed.substr(0, 3);
    const std::string_view bayer = printed.substr(3, 4);
    append(text, size, bayer.find_first_not_of(' ') != std::string_view::npos ? bayer : flamsteed);
    text[size++] = ' ';
    append(text, size, printed.substr(7));
  } else {
    append(text, size, "HR");
    text[size++] = ' ';
    size = static_cast<std::size_t>(std::to_chars(text.data() + size, text.data() + text.size(), hr).ptr -
                                    text.data());
  }
  return Name(std::string_view(text.data(), size));
}

Name star_label(std::uint16_t hr) noexcept {
  const std::string_view name = proper_name(hr);
  return name.empty() ? star_designation(hr) : Name(name);
}

}  // namespace omma
