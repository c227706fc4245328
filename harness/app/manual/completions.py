"""Completion for bash, zsh and fish: verbs, options, and the words that an option or argument may be."""

# Options whose words the program lists.
LISTED = {
    "--functions": "functions",
    "--types": "types",
    "--strata": "strata",
    "--kernels": "kernels",
    "--integrator": "integrators",
    "--integrators": "integrators",
}
# Arguments by verb: of each place what is listed there.
PLACES = {
    ("at",): ("functions+kernels", "types"),
    ("search",): ("functions", "types"),
    ("scene", "run"): ("scenes",),
    ("scene", "explain"): ("scenes",),
    ("scene", "compare"): ("scenes",),
    ("scene", "ladder"): ("scenes",),
    ("scene", "correlate"): ("scenes",),
    ("scene", "speed"): ("scenes",),
}


def _words_of(verb, listed):
    """The words that may stand at the first place of a verb that is no option."""
    found = [one.names[0] for one in verb.verbs]
    for one in verb.positionals[:1]:
        found += one.choices
    places = PLACES.get(verb.words, ())
    return found + [word for name in places[:1] for word in _listed(name, listed)]


def _listed(name, listed):
    return [word for part in name.split("+") for word in listed[part]]


def _long(option):
    return [name for name in option.names if name.startswith("-")]


def _option_words(verb, listed):
    """{option: the words it may be} of those that have such."""
    found = {}
    for option in verb.options:
        for name in _long(option):
            if name in LISTED:
                found[name] = ["all", *listed[LISTED[name]]]
            elif option.choices:
                found[name] = list(option.choices)
    return found


def _quoted(words):
    return "'" + " ".join(words) + "'"


def bash(tree, listed):
    """A completion function; lists with commas are completed behind the last comma."""
    taking = [o for verb in tree.values() for o in verb.options if o.valued]
    valued = "|".join(sorted({name for o in taking for name in _long(o)}))
    lines = [
        "# bash completion for ulpgate.  Made from its --help.",
        "_ulpgate() {",
        '  local cur="${COMP_WORDS[COMP_CWORD]}" prev="" verb="" place=0 i word skip=0',
        '  [ "$COMP_CWORD" -gt 0 ] && prev="${COMP_WORDS[COMP_CWORD-1]}"',
        "  for ((i = 1; i < COMP_CWORD; i++)); do",
        '    word="${COMP_WORDS[i]}"',
        "    if [ $skip = 1 ]; then skip=0; continue; fi",
        '    case "$word" in',
        f"      {valued}) skip=1 ;;",
        "      -*) ;;",
        '      *) case "$verb $word" in',
    ]
    for words in filter(None, tree):
        seen = f"{' '.join(words[:-1])} {words[-1]}"
        verb = " ".join(words)
        lines.append(f'           "{seen}") verb="{verb}"; place=0 ;;')
    lines += [
        "           *) place=$((place + 1)) ;;",
        "         esac ;;",
        "    esac",
        "  done",
        '  local words="" prefix=""',
        '  case "$verb:$prev" in',
    ]
    for words, verb in tree.items():
        for option, of in _option_words(verb, listed).items():
            lines.append(f'    "{" ".join(words)}:{option}") words={_quoted(of)} ;;')
    lines += ["    *)", '      case "$verb:$place:$cur" in']
    for words, verb in tree.items():
        options = [name for option in verb.options for name in _long(option)]
        key = " ".join(words)
        lines.append(f'        "{key}":*:-*) words={_quoted(options)} ;;')
        first = _words_of(verb, listed)
        if first:
            lines.append(f'        "{key}":0:*) words={_quoted(first)} ;;')
        for place, name in enumerate(PLACES.get(words, ())[1:], 1):
            of = _quoted(_listed(name, listed))
            lines.append(f'        "{key}":{place}:*) words={of} ;;')
    lines += [
        "      esac ;;",
        "  esac",
        '  case "$cur" in *,*) prefix="${cur%,*},"; cur="${cur##*,}" ;; esac',
        '  [ -n "$words" ] || { COMPREPLY=(); return; }',
        '  mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$words" -- "$cur")',
        "}",
        "complete -o default -F _ulpgate ulpgate",
        "",
    ]
    return "\n".join(lines)


def zsh(tree, listed):
    """The bash function under zsh's emulation, which zsh ships."""
    return "\n".join(
        (
            "#compdef ulpgate",
            "# zsh completion for ulpgate.  Made from its --help.",
            "autoload -U +X bashcompinit && bashcompinit",
            bash(tree, listed).replace(
                'mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$words" -- "$cur")',
                'COMPREPLY=($(compgen -P "$prefix" -W "$words" -- "$cur"))',
            ),
        )
    )


def _fish_text(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish(tree, listed):
    """One line a verb and option."""
    lines = [
        "# fish completion for ulpgate.  Made from its --help.",
        "complete -c ulpgate -e",
    ]
    for words, verb in tree.items():
        seen = " ".join(f"__fish_seen_subcommand_from {w};" for w in words)
        seen = seen.replace("; __", "; and __").rstrip(";") or "__fish_use_subcommand"
        below = [one.names[0] for one in verb.verbs]
        here = seen
        if words and below:
            here += f"; and not __fish_seen_subcommand_from {' '.join(below)}"
        for one in verb.verbs:
            lines.append(
                f"complete -c ulpgate -f -n {_fish_text(here)} -a {one.names[0]} -d {_fish_text(one.text)}"
            )
        first = [w for w in _words_of(verb, listed) if w not in below]
        if first:
            lines.append(
                f"complete -c ulpgate -n {_fish_text(here)} -a {_quoted(first)}"
            )
        of = _option_words(verb, listed)
        for option in verb.options:
            for name in (n for n in option.names if n.startswith("--")):
                takes = ""
                if option.valued:
                    takes = " -r" if name not in of else f" -x -a {_quoted(of[name])}"
                lines.append(
                    f"complete -c ulpgate -n {_fish_text(here)} -l {name[2:]}{takes} -d {_fish_text(option.text)}"
                )
    return "\n".join(lines) + "\n"
