#!/usr/bin/env bash
# Needs the parts: draw
# tartan draw of fields: the same picture at any number of threads, from any side; limits, wrong use.
name=draw_field
source "$(dirname "$0")/golden.bash"
cd "$scratch"
printf 'surface ball "a ball" = x*x + y*y + z*z - 9\nsurface two = min(ball at (x - 3, y, z), ball at (x + 3, y, z))\ngrid 40\n' >ball.field

for format in png svg pdf; do
    "$TARTAN" draw ball.field -o a.$format --threads 1 || fail "no $format is drawn"
    "$TARTAN" draw ball.field -o b.$format --threads 4
    cmp a.$format b.$format || fail "threads change the $format"
    "$TARTAN" draw ball.field --azimuth 90 --elevation 0 -o c.$format
    ! cmp -s a.$format c.$format || fail "the $format is the same from another side"
done
# Nothing inside is a picture of nothing, with its title.
echo 'surface none = 0.5' >none.field
for format in png svg pdf; do
    exits 0 "$TARTAN" draw none.field -o none.$format
done
grep -q '<svg' none.svg || fail 'a picture of nothing is no SVG'
# As large as was asked for: 300 points at 72 dpi. From the front, two balls are twice as wide as one.
"$TARTAN" draw ball.field --width 300 --dpi 72 --elevation 0 --azimuth -90 --title '' -o wide.png
"$TARTAN" draw ball.field --width 300 --dpi 72 --elevation 0 --azimuth 0 --title '' -o side.png
size() { python3 -c 'import struct, sys; print(*struct.unpack(">II", open(sys.argv[1], "rb").read()[16:24]))' "$1"; }
is 'two balls' "$(size wide.png)" '300 182'
is 'one behind the other' "$(size side.png)" '300 318'
"$TARTAN" build ball.field -o ball.tnb
"$TARTAN" draw ball.tnb -o module.png
cmp module.png a.png || fail 'the module is drawn otherwise'
# Open at the box: one sees into the form, by pixels as by outlines; where the box cuts nothing, it is the same picture.
printf 'surface pipe = x*x + y*y - 9 grid 30\n' >pipe.field
for format in png svg; do
    "$TARTAN" draw pipe.field -o closed.$format 2>/dev/null
    "$TARTAN" draw pipe.field --open -o open.$format 2>/dev/null || fail "no open $format is drawn"
    ! cmp -s closed.$format open.$format || fail "--open changes nothing of the $format"
    "$TARTAN" draw ball.field --open -o o.$format
    [ $format = svg ] || cmp o.$format a.$format || fail "--open changes a form that the box does not cut"
done
golden open "tartan draw table --open -o $scratch/x.png"
golden rule "tartan draw $scratch/ball.field --rule x -o $scratch/x.png"
golden azimuth "tartan draw sheds.plan --sample 3 --azimuth 3 -o $scratch/x.png"
golden name "tartan draw $scratch/ball.field -o $scratch/x.obj"
golden surface "tartan draw $scratch/ball.field --surface bal -o $scratch/x.png"
golden large "tartan draw $scratch/ball.field --grid 300 -o $scratch/x.svg"
finish
