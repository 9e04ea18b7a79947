#!/usr/bin/env python3
"""Checks the Markdown that the project ships: links resolve, Lua blocks compile, console examples print what they say.

    check_docs.py --bin BUILD/bin --root REPOSITORY [FILE.md...]

A ```lua block is checked by shaderc; `<!-- check: refused -->` on the line before it says that it must be refused,
`<!-- check: syntax -->` that it is Lua but not a shader of its own (a fragment or a scene), and only luac reads it.
A block that follows `<!-- file: NAME -->` is written under that name for the console examples of its page. In a
```console block each line `$ COMMAND` runs in a scratch folder (with the page's files and the gallery's shaders in it);
the lines after it are what it must print, where `...` stands for any text. Exits 1 and lists what is wrong.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse


def anchors(text):
    """GitHub's anchors of a page's headings."""
    result = set()
    for heading in re.findall(r'^#+\s+(.*)$', re.sub(r'```.*?```', '', text, flags=re.S), re.M):
        plain = re.sub(r'[`*]|\[([^\]]*)\]\([^)]*\)', r'\1', heading).strip().lower()
        result.add(re.sub(r'[^\w\- ]', '', plain).replace(' ', '-'))
    return result


def check_links(page, root, problems):
    text = page.read_text()
    prose = re.sub(r'```.*?```', '', text, flags=re.S)
    prose = re.sub(r'`[^`\n]*`', '', prose)
    for target in re.findall(r'\]\(([^)\s]+)\)', prose):
        if re.match(r'[a-z]+:', target):
            continue
        path, _, anchor = urllib.parse.unquote(target).partition('#')
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            problems.append(f'{page.relative_to(root)}: link to {target}: no such file')
        elif anchor and file.suffix == '.md' and anchor not in anchors(file.read_text()):
            problems.append(f'{page.relative_to(root)}: link to {target}: no such heading')


def blocks(page):
    """(line number, language, preceding comments, text) of each fenced block."""
    lines = page.read_text().split('\n')
    i = 0
    comments = []
    while i < len(lines):
        fence = re.match(r'```(\w*)\s*$', lines[i])
        if fence:
            end = next(j for j in range(i + 1, len(lines)) if lines[j].startswith('```'))
            yield i + 1, fence.group(1), comments, '\n'.join(lines[i + 1:end]) + '\n'
            comments = []
            i = end
        else:
            comment = re.match(r'<!--\s*(\w+):\s*(.*?)\s*-->\s*$', lines[i])
            if comment:
                comments.append((comment.group(1), comment.group(2)))
            elif lines[i].strip():
                comments = []
        i += 1


def run(command, folder, environment):
    return subprocess.run(command, shell=True, cwd=folder, env=environment, text=True, timeout=300,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, executable='/bin/bash')


def check_console(text, where, folder, environment, problems):
    examples = []
    for line in text.splitlines():
        if line.startswith('$ '):
            examples.append((line[2:], []))
        elif examples:
            examples[-1][1].append(line)
    for command, expected in examples:
        printed = run(command, folder, environment).stdout.rstrip('\n')
        pattern = '.*'.join(re.escape(part) for part in '\n'.join(expected).rstrip('\n').split('...'))
        if not re.fullmatch(pattern, printed, re.S):
            problems.append(f'{where}: `{command}` printed\n{printed}\nwhere the page says\n' + '\n'.join(expected))


def check_page(page, root, environment, problems):
    check_links(page, root, problems)
    count = 0
    with tempfile.TemporaryDirectory() as scratch:
        for shader in (root / 'shaders').glob('*'):
            if shader.suffix in ('.lua', '.obj', '.mtl', '.png'):
                shutil.copy(shader, scratch)
        for line, language, comments, text in blocks(page):
            where = f'{page.relative_to(root)}:{line}'
            how = dict(comments).get('check', 'shader')
            name = dict(comments).get('file', 'example.lua')
            if language == 'lua':
                count += 1
                (pathlib.Path(scratch) / name).write_text(text)
                if how == 'syntax':
                    result = run(f'luac5.4 -p {name}', scratch, environment)
                else:
                    result = run(f'shaderc {name}', scratch, environment)
                if (result.returncode != 0) != (how == 'refused'):
                    problems.append(f'{where}: this block was {"accepted" if how == "refused" else "refused"}:\n'
                                    + result.stdout)
            elif language == 'console':
                count += 1
                check_console(text, where, scratch, environment, problems)
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--bin', required=True, type=pathlib.Path)
    parser.add_argument('--root', required=True, type=pathlib.Path)
    parser.add_argument('pages', nargs='*', type=pathlib.Path)
    options = parser.parse_args()
    root = options.root.resolve()
    environment = {**os.environ, 'PATH': f'{options.bin.resolve()}:{os.environ["PATH"]}', 'NO_COLOR': '1'}
    pages = [page.resolve() for page in options.pages] or [root / 'README.md', *sorted((root / 'docs').rglob('*.md'))]
    problems = []
    count = sum(check_page(page, root, environment, problems) for page in pages)
    for shader in sorted((root / 'shaders').glob('*.lua')):
        if not shader.name.endswith('.scene.lua') and not shader.name.startswith('make_'):
            count += 1
            result = run(f'shaderc {shader}', root, environment)
            if result.returncode or result.stdout:
                problems.append(f'{shader.relative_to(root)}: shaderc says\n{result.stdout}')
    print('\n'.join(problems) or f'{len(pages)} pages, {count} examples and shaders: all as they say')
    return 1 if problems or not count else 0


if __name__ == '__main__':
    sys.exit(main())
