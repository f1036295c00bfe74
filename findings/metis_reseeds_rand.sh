#!/bin/sh
# Ordering a matrix with METIS through CHOLMOD sets the program's own rand() back: a Monte Carlo draws the same case again.
#
# METIS 5.1.0 (libmetis5 5.1.0.dfsg-7 of Debian 12) makes its choices with the C library's rand() and calls srand() with its
# own seed, 4321 unless told, at every ordering. cholmod_analyze (libcholmod3 1:5.12.0+dfsg-2) tries it where AMD's
# ordering fills much, or where it is asked for. So with srand(1), srand(2), ... before it, rand() after it is always
#   the same number (738887548 for a grid of 40 x 40)
# and whoever samples stiffnesses with rand(), one solve a sample, gets one sample many times. Two orderings at one time
# can take draws from each other. METIS' manual says only that the seed is that of its random number generator. Keep draws
# in a generator of your own, and orderings under one lock.
# Fails if rand() goes on undisturbed. Needs Debian 12's packages (apt-get), gcc.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    libsuitesparse-dev=1:5.12.0+dfsg-2 libcholmod3=1:5.12.0+dfsg-2 libmetis5=5.1.0.dfsg-7 >apt.log 2>&1 ||
    { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
cat >draw.c <<'C'
#include <cholmod.h>
#include <stdio.h>
#include <stdlib.h>
enum { SIDE = 40 };
static void put(cholmod_triplet *t, int row, int column, double value)
{
    ((int *)t->i)[t->nnz] = row;
    ((int *)t->j)[t->nnz] = column;
    ((double *)t->x)[t->nnz++] = value;
}
int main(void)
{
    cholmod_common c;
    cholmod_start(&c);
    c.nmethods = 1;
    cholmod_triplet *t = cholmod_allocate_triplet(SIDE * SIDE, SIDE * SIDE, 3 * SIDE * SIDE, 1, CHOLMOD_REAL, &c);
    for (int k = 0; k < SIDE * SIDE; k++) {
        put(t, k, k, 5);
        if (k % SIDE) put(t, k - 1, k, -1);
        if (k >= SIDE) put(t, k - SIDE, k, -1);
    }
    cholmod_sparse *grid = cholmod_triplet_to_sparse(t, 0, &c);
    const int orderings[] = {CHOLMOD_AMD, CHOLMOD_METIS};
    for (int o = 0; o < 2; o++) {
        c.method[0].ordering = orderings[o];
        printf("%s:", o ? "METIS" : "AMD");
        for (unsigned seed = 1; seed <= 4; seed++) {
            srand(seed);
            cholmod_factor *factor = cholmod_analyze(grid, &c);
            printf(" %d", rand());
            cholmod_free_factor(&factor, &c);
        }
        printf("\n");
    }
    return 0;
}
C
lib=$work/root/usr/lib/x86_64-linux-gnu
gcc -O1 -I root/usr/include/suitesparse draw.c -o draw -L "$lib" -lcholmod -Wl,-rpath-link,"$lib" || exit 1
LD_LIBRARY_PATH=$lib:$lib/openblas-pthread:$lib/blas:$lib/lapack ./draw >draws.txt
sed 's/^/rand() after seeds 1 to 4 and an ordering by /' draws.txt
[ "$(sed -n 's/^AMD: //p' draws.txt | tr ' ' '\n' | sort -u | wc -l)" = 4 ] || { echo "AMD disturbs rand() too"; exit 1; }
[ "$(sed -n 's/^METIS: //p' draws.txt | tr ' ' '\n' | sort -u | wc -l)" = 1 ] || { echo "METIS leaves rand() alone now"; exit 1; }
echo "as found: METIS sets rand() back"
