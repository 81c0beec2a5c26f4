// SPDX-License-Identifier: GPL-2.0-or-later
// OpenFOAM 1912 as a newer GCC builds it cannot read function objects: "error in
// IOstream "sha1"". Its stream for digests takes rows of characters, but no single one;
// operator<<(char) of libstdc++ 14 (Debian 13) puts single ones. This library, loaded
// before OpenFOAM's, has the class of OSHA1stream.H anew, with the missing function:
// the loader takes the first table of virtual functions of a name.
#include <ostream>
#include <streambuf>

#include "SHA1.H"

namespace Foam {

class osha1stream : virtual public std::ios, public std::ostream {
    class sha1buf : public std::streambuf {
        SHA1 sha1_;

      protected:
        std::streamsize xsputn(const char* from, std::streamsize n) override;
        int_type overflow(int_type character) override;
    };
};

std::streamsize osha1stream::sha1buf::xsputn(const char* from, std::streamsize n) {
    sha1_.append(from, static_cast<std::size_t>(n));
    return n;
}

std::streambuf::int_type osha1stream::sha1buf::overflow(int_type character) {
    if (traits_type::eq_int_type(character, traits_type::eof()))
        return traits_type::not_eof(character);
    const char one = traits_type::to_char_type(character);
    sha1_.append(&one, 1);
    return character;
}

}  // namespace Foam
