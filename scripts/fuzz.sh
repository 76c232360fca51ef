#!/bin/sh
# fuzz.sh BUILD SECONDS: run every fuzzer of a fuzz build for that long, one after the other; inputs found stay in BUILD/corpus.
set -eu
build=$1; seconds=$2
failed=0
for fuzzer in "$build"/tests/fuzz/fuzz_*; do
  [ -x "$fuzzer" ] && [ -f "$fuzzer" ] || continue
  name=$(basename "$fuzzer")
  mkdir -p "$build/corpus/$name"
  case $name in
    fuzz_lcp_text | fuzz_exact_lcp_text) printf 'M\n2 1\n1 2\nq\n-1 -1/2\n' >"$build/corpus/$name/seed" ;;
    fuzz_scene_toml)
      cp scenes/*.toml "$build/corpus/$name/"
      # What toml++ 3.3 must not see: headers without a name, characters beyond ASCII where none may stand.
      for text in '[//' '[&' '[[[' '\357\273\237-' 'x = \303\251' 'x = \343\200\201' 'x = 04"""\357\273\276"""' \
          'x = """\\\n\357\273\276"""' 'x=1="\357\271\277"'; do
        printf "$text" >"$build/corpus/$name/seed$(printf "$text" | cksum | cut -d' ' -f1)"
      done ;;
    fuzz_trajectory_csv)
      tables=tests/output/data/two_balls
      { cat $tables.csv; printf '\000'; cat $tables.contacts.csv; } >"$build/corpus/$name/seed" ;;
    fuzz_record_npz) cp tests/output/data/*.npz "$build/corpus/$name/" ;;
  esac
  echo "$name: $seconds s"
  if ! "$fuzzer" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -verbosity=0 -print_final_stats=1 \
      -artifact_prefix="$build/$name-" "$build/corpus/$name" 2>"$build/$name.log"; then
    failed=1
    tail -n 30 "$build/$name.log"
  fi
  grep -a 'number_of_executed_units' "$build/$name.log" || true
done
exit $failed
