#!/usr/bin/env python3
"""Uses the bench carelessly and as an enemy would, and says what it made of it.

usage: attack.py ROOT FOLDER_OF_PROGRAMS [GROUP...]

Handled means: it ends in time, not by a signal, with the exit code that the attack deserves, in few lines.
Loopback only. Exit code: 0 every attack was handled; 1 not.
"""
import os
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = os.path.abspath(sys.argv[1])
BIN = os.path.abspath(sys.argv[2])
ONLY = sys.argv[3:]
BENCH, PANEL, STUDY = (os.path.join(BIN, 'towbench-' + name) for name in ('bench', 'panel', 'study'))
PATIENCE_S = 20
MOST_LINES = 12
PASS, FAIL, BAD, RUNTIME, INVALID = 0, 1, 2, 3, 4

work = tempfile.TemporaryDirectory(prefix='towbench-attack-')
os.chdir(work.name)
os.symlink(os.path.join(ROOT, 'fixtures'), 'fixtures')
os.mkfifo('fifo')
os.mkdir('a folder')
open('binary', 'wb').write(bytes(range(256)) * 64)

tried, missed = {}, {}


def count(group, name, trouble):
    tried[group] = tried.get(group, 0) + 1
    if trouble:
        missed.setdefault(group, []).append(f'{name}: {trouble}')
        print(f'not handled: {group}: {name[:160]}: {trouble}', flush=True)


def run(command, send=None, after_s=None, patience_s=PATIENCE_S):
    """Exit code (negative: a signal; None: it did not end) and what it printed."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        if send is not None:
            try:
                output, _ = process.communicate(timeout=after_s)
                return process.returncode, output
            except subprocess.TimeoutExpired:
                process.send_signal(send)
        output, _ = process.communicate(timeout=patience_s)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, b''


def judged(code, output, allowed):
    if code is None:
        return f'still running after {PATIENCE_S} s'
    if code < 0 or code > 99:
        return f'ended by signal {-code if code < 0 else code - 128}'
    if code not in allowed:
        return f'exit code {code}, not one of {sorted(allowed)}'
    if code == BAD and output.count(b'\n') > MOST_LINES:
        return f'{output.count(bytes([10]))} lines for bad input'
    return ''


def attack(group, command, allowed, **how):
    code, output = run(command, **how)
    count(group, ' '.join(str(part)[:60] for part in command[1:]), judged(code, output, allowed))


# ---- options: every option of every verb with every hostile value
NO_NUMBER = ['-1', 'nan', 'inf', '1e300', '', '0x10', '9' * 40, '1;2', 'x' * 100_000]
HOSTILE_TEXT = ['', '/dev/zero', 'fifo', 'a folder', '../../../../etc/passwd', '%s%n%s', 'binary', 'no/such', 'x' * 100_000,
                b'\xff\xfe', '-', '--', '/proc/self/mem']
# A call that ends soon, to which the option is added. A verb that serves is ended by SIGTERM.
VERBS = {
    'run': (BENCH, ['pulses', '--no-report', '-q'], False),
    'campaign': (BENCH, ['mutants', '--only', 'no such case', '--workers', '1', '--out', 'camp'], False),
    'emulate': (BENCH, ['--rig', 'fixtures/rigs/macs-nominal.toml', '--listen', 'local:s/one', '--patience', '1'], False),
    'control': (BENCH, ['--controller', 'fixtures/controllers/bbmc-tuned.toml', '--rig', 'fixtures/rigs/macs-nominal.toml',
                        '--fast'], False),
    'replay': (BENCH, ['no-such-folder'], False),
    'report': (BENCH, ['no-such-folder'], False),
    'validate': (BENCH, ['fixtures/rigs/macs-nominal.toml'], False),
    'list': (BENCH, [], False),
    'demo': (BENCH, ['-q'], False),
    'doctor': (BENCH, ['--seconds', '0'], False),
    'panel': (PANEL, [], True),
    'identify': (STUDY, ['--data', 'no-such-log.csv'], False),
    'tow': (STUDY, ['--only', 'no-such-experiment'], False),
    'diagnose': (STUDY, ['--data', 'no-such-log.csv'], False),
}


def options_of(program, verb):
    text = run([program, verb, '--help'])[1].decode()
    return re.findall(r'^\s+(?:-\w,)?(--[\w-]+)(?:,--[\w-]+)? (TEXT|UINT|INT|FLOAT)', text, re.M)


def attack_options():
    for verb, (program, base, serves) in VERBS.items():
        for option, kind in options_of(program, verb):
            without = list(base)
            if option in without:
                at = without.index(option)
                del without[at:at + 2]
            numeric = kind != 'TEXT'
            for value in NO_NUMBER if numeric else HOSTILE_TEXT:
                allowed = {BAD} if numeric else {PASS, FAIL, BAD, RUNTIME, INVALID, 99}
                how = {'send': signal.SIGTERM, 'after_s': 0.5} if serves else {}
                if option in ('--slurm-option',):
                    continue  # of --slurm only
                attack('options', [program, verb, *without, option, value], allowed, **how)


# ---- arguments: what stands where a file or a folder should
def attack_arguments():
    os.mkdir('an empty folder')
    names = ['', '/dev/zero', '/dev/full', 'fifo', 'an empty folder', 'binary', '../../../../etc/passwd', 'never/made', 'x' * 100_000, '%s%n',
             b'\xff', '/proc/self/mem', '/', '---', 'circle\n', 'circle.toml']
    for verb in ('run', 'campaign', 'validate', 'report', 'replay', 'emulate'):
        for name in names:
            attack('arguments', [BENCH, verb, name], {BAD})
    for verb in ('nonsense', '', '-', '--', 'x' * 100_000, b'\xff'):
        attack('arguments', [BENCH, verb], {BAD})


# ---- fixtures: each number of shipped files made hostile, and texts that are hardly TOML
def attack_fixtures():
    rng = random.Random(1)
    files = ['experiments/circle.toml', 'plants/macs-nominal.toml', 'controllers/bbmc-tuned.toml', 'rigs/macs-nominal.toml',
             'campaigns/mutants.toml', 'faults/y-max-open-and-kill.toml']
    for file in files:
        source = os.path.join(ROOT, 'fixtures', file)
        lines = open(source, encoding='utf-8').read().split('\n')
        folder = os.path.join(os.getcwd(), 'set', os.path.dirname(file))
        os.makedirs(folder, exist_ok=True)
        for kind in ('rigs', 'plants', 'controllers', 'experiments', 'motions'):
            link = os.path.join(os.getcwd(), 'set', kind)
            if not os.path.exists(link) and kind != os.path.dirname(file):
                os.symlink(os.path.join(ROOT, 'fixtures', kind), link)
        target = os.path.join(os.getcwd(), 'set', 'hostile.toml')
        numbers = [i for i, line in enumerate(lines) if re.match(r'^\w+ = -?[\d.]', line)]
        for i in rng.sample(numbers, min(8, len(numbers))):
            key = lines[i].split(' = ')[0]
            for value in ('1e300', 'nan', '-inf', '"text"', '[]', '{}', '9' * 400):
                changed = [line.replace('"../', '"' + os.path.relpath(os.path.join(ROOT, 'fixtures'), os.path.dirname(target)) + '/')
                           for line in lines]
                changed[i] = f'{key} = {value}'
                open(target, 'w', encoding='utf-8').write('\n'.join(changed))
                code, output = run([BENCH, 'validate', target])
                count('fixtures', f'{file}: {key} = {value[:10]}', judged(code, output, {BAD}))
        os.path.exists(target) and os.unlink(target)
    deep = 'a.' * 50_000
    for text in (b'', b'\0' * 100, b'\xff\xfe', b'schema = 1\n' + deep.encode() + b'a = 1\n', b'schema = ' + b'[' * 100_000,
                 b'schema = 1\nx = ' + b'{a=' * 10_000, b'schema = 1\n' * 2, b'[schema]\n' * 3, b'schema = 2\n', b'schema = "1"\n',
                 b'x' * (2 << 20), b'schema = 1\n[[fault]]\n' * 1000, b'schema = 1\r\nname = "a\r\n', b'schema = 1\n#' + b'x' * 900_000,
                 b'schema = 1\nrig = "/etc/passwd"\n', b'schema = 1\nrig = "../../../../../../etc/passwd"\n',
                 b'schema = 1\nrig = "fifo"\n', b'schema = 1\nrig = "."\n', '\ufeffschema = 1\n'.encode()):
        open('text.toml', 'wb').write(text)
        attack('fixtures', [BENCH, 'validate', 'text.toml'], {BAD})


# ---- folders: a run that somebody has changed
def attack_folders():
    code, _ = run([BENCH, 'run', 'trapezoid-400', '-q', '--out', 'attacked'])
    folder = os.path.join('attacked', os.listdir('attacked')[0])
    count('folders', 'the run itself', '' if code == PASS else f'exit code {code}')
    # What is refused below is refused for the change alone.
    for verb in ([BENCH, 'report', folder], [BENCH, 'replay', folder], [STUDY, 'diagnose', '--data', folder, '--out', 'diagnosis', '-q']):
        code, output = run(verb)
        count('folders', f'{verb[1]} of the untouched run', judged(code, output, {PASS}))

    def check(name, path, change):
        kept = open(path, 'rb').read()
        try:
            change(path, kept)
            for verb, allowed in (('report', {INVALID}), ('replay', {BAD, RUNTIME, INVALID})):
                code, output = run([BENCH, verb, folder])
                count('folders', f'{verb} after {name}', judged(code, output, allowed))
            code, output = run([STUDY, 'diagnose', '--data', folder, '--out', 'diagnosis', '-q'])
            # A diagnosis never opens what only the plant knows.
            unread = os.path.basename(path) in ('truth.csv', 'events.jsonl', 'metrics.json')
            count('folders', f'diagnose after {name}', judged(code, output, {BAD, RUNTIME, INVALID} | ({PASS} if unread else set())))
        finally:
            if os.path.lexists(path):
                os.unlink(path)
            open(path, 'wb').write(kept)

    def as_written(new):
        return lambda path, kept: open(path, 'wb').write(new(kept))

    def as_pipe(path, _):
        os.unlink(path)
        os.mkfifo(path)

    changes = {
        'emptied': as_written(lambda kept: b''),
        'halved': as_written(lambda kept: kept[:len(kept) // 2]),
        'random bytes inside': as_written(lambda kept: kept[:len(kept) // 2] + os.urandom(40) + kept[len(kept) // 2 + 40:]),
        'a digit changed': as_written(lambda kept: re.sub(rb'1', b'2', kept, count=1)),
        'a line twice': as_written(lambda kept: kept + kept[kept.rfind(b'\n', 0, -1) + 1:]),
        'removed': lambda path, kept: os.unlink(path),
        'a pipe': as_pipe,
    }
    for file in ('log.csv', 'truth.csv', 'events.jsonl', 'result.json', 'metrics.json', 'manifest.json'):
        for name, change in changes.items():
            path = os.path.join(folder, file)
            if os.path.exists(path):
                check(f'{file} {name}', path, change)
    for base, _, names in os.walk(os.path.join(folder, 'inputs')):
        for name in names:
            check(f'inputs/{name} edited', os.path.join(base, name), changes['a digit changed'])
    result = os.path.join(folder, 'result.json')
    check('result.json says PASS with a broken limit', result, as_written(lambda kept: re.sub(rb'"max": [^,]+,', b'"max": 1e9,', kept)))
    check('result.json of 40 MB', result, as_written(lambda kept: kept[:-2] + b',"x":"' + b'y' * (40 << 20) + b'"}'))


# ---- signals: ended in the middle, in any way that is asked for politely
def attack_signals():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        for at_s in (0.02, 0.1, 0.4):
            out = f'signals-{number}-{at_s}'
            code, _ = run([BENCH, 'run', 'circles-20min', '--no-report', '-q', '--out', out], send=number, after_s=at_s)
            name = f'{number} after {at_s} s'
            ended = code == RUNTIME or (code == -number and not os.path.exists(out))  # before it could listen
            count('signals', name, '' if ended else f'exit code {code}')
            for folder in os.listdir(out) if os.path.exists(out) else []:
                text = open(os.path.join(out, folder, 'result.json'), encoding='utf-8').read()
                count('signals', name + ', its record', '' if '"status": "incomplete"' in text else 'is called complete')
    attack('signals', ['bash', '-c', f'{BENCH} list > /dev/full'], {RUNTIME})
    attack('signals', ['bash', '-c', f'{BENCH} run pulses --json --no-report --out full > /dev/full'], {RUNTIME})


# ---- wire: a controller that babbles, at an emulator that a person started
def attack_wire():
    rng = random.Random(2)
    os.makedirs('s', mode=0o700, exist_ok=True)
    os.chmod('s', 0o700)
    bursts = [b'', b'\0' * 10_000, b'\xff' * 10_000, rng.randbytes(100), rng.randbytes(100_000), b'GET / HTTP/1.1\r\n\r\n' * 50,
              b'\x54\x42' * 5_000, rng.randbytes(3)]
    for i, burst in enumerate(bursts * 2):
        path = os.path.join('s', f'w{i}')
        process = subprocess.Popen([BENCH, 'emulate', '--rig', 'fixtures/rigs/macs-nominal.toml', '--listen', 'local:' + path],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        peer = socket.socket(socket.AF_UNIX)
        for _ in range(200):
            try:
                peer.connect(path)
                break
            except OSError:
                time.sleep(0.02)
        try:
            peer.settimeout(2)
            peer.sendall(burst)
            if i >= len(bursts):
                time.sleep(0.05)
        except OSError:
            pass
        peer.close()
        time.sleep(0.05)
        process.send_signal(signal.SIGTERM)
        try:
            _, said = process.communicate(timeout=5)
            trouble = judged(process.returncode, said, {PASS, RUNTIME, INVALID})
            if not trouble and process.returncode == PASS:
                trouble = 'a babbling controller counts as a good end'
        except subprocess.TimeoutExpired:
            process.kill()
            trouble = 'does not end'
        count('wire', f'burst {i}', trouble or ('.lock is left' if os.path.exists(path + '.lock') else ''))


# ---- panel: requests that no browser makes
def attack_panel():
    process = subprocess.Popen([PANEL, 'panel', '--out', 'panel-runs'], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT)
    text, match = b'', None
    while match is None:
        text += process.stdout.readline()
        match = re.search(rb'http://127\.0\.0\.1:(\d+)/\?ticket=(\w+)', text)
    port = int(match.group(1))

    def ask(request, wait_s=3.0):
        with socket.create_connection(('127.0.0.1', port), timeout=wait_s) as peer:
            try:
                peer.sendall(request)
                answer = b''
                while part := peer.recv(65536):
                    answer += part
                    if len(answer) > 1 << 20:
                        break
            except OSError:
                pass
            return answer

    host = b'Host: 127.0.0.1:%d\r\n' % port

    def alive():
        return b'HTTP/1.1' in ask(b'GET / HTTP/1.1\r\n' + host + b'\r\n')

    def refused(name, request):
        answer = ask(request)
        good = not answer or re.match(rb'HTTP/1\.[01] (4\d\d|5\d\d|3\d\d)', answer)
        count('panel', name, '' if good and alive() else f'answered {answer[:60]!r}')

    paths = [b'/', b'/runs', b'/runs/../../etc/passwd', b'/%2e%2e/%2e%2e/etc/passwd', b'/runs/%00', b'/?ticket=', b'/?ticket=' + b'0' * 64,
             b'/' + b'a' * 7000, b'/socket', b'*', b'http://evil/', b'//', b'/runs/a/../../b', b'/\xff\xfe']
    for method in (b'GET', b'POST', b'PUT', b'DELETE', b'OPTIONS', b'TRACE', b'CONNECT'):
        for path in paths:
            refused((method + b' ' + path[:40]).decode('latin1'), method + b' ' + path + b' HTTP/1.1\r\n' + host + b'\r\n')
    for name, request in {
            'another host': b'GET / HTTP/1.1\r\nHost: evil\r\n\r\n',
            'no host': b'GET / HTTP/1.1\r\n\r\n',
            'another origin': b'GET / HTTP/1.1\r\n' + host + b'Origin: http://evil\r\n\r\n',
            'a header of 100 kB': b'GET / HTTP/1.1\r\n' + host + b'X: ' + b'y' * 100_000 + b'\r\n\r\n',
            'ten thousand headers': b'GET / HTTP/1.1\r\n' + host + b'X: y\r\n' * 10_000 + b'\r\n',
            'a body': b'POST / HTTP/1.1\r\n' + host + b'Content-Length: 99999999\r\n\r\n' + b'x' * 1000,
            'a negative length': b'POST / HTTP/1.1\r\n' + host + b'Content-Length: -1\r\n\r\n',
            'two lengths': b'POST / HTTP/1.1\r\n' + host + b'Content-Length: 1\r\nContent-Length: 2\r\n\r\nx',
            'chunks without end': b'POST / HTTP/1.1\r\n' + host + b'Transfer-Encoding: chunked\r\n\r\nffffffff\r\n',
            'no HTTP': os.urandom(2000),
            'a socket without a key': b'GET /socket HTTP/1.1\r\n' + host + b'Upgrade: websocket\r\nConnection: Upgrade\r\n\r\n',
            'a socket of another origin': b'GET /socket HTTP/1.1\r\n' + host + b'Origin: http://evil\r\nUpgrade: websocket\r\n'
                                          b'Connection: Upgrade\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n'
                                          b'Sec-WebSocket-Version: 13\r\n\r\n'}.items():
        refused(name, request)
    half_open = []
    for _ in range(300):
        peer = socket.create_connection(('127.0.0.1', port), timeout=3)
        peer.sendall(b'GET / HT')
        half_open.append(peer)
    started = time.monotonic()
    answered = alive()
    count('panel', '300 half-open connections', '' if answered and time.monotonic() - started < 2 else 'lock others out')
    for peer in half_open:
        peer.close()
    process.send_signal(signal.SIGTERM)
    try:
        process.communicate(timeout=5)
        count('panel', 'its end', '' if process.returncode in (PASS, RUNTIME) else f'exit code {process.returncode}')
    except subprocess.TimeoutExpired:
        process.kill()
        count('panel', 'its end', 'does not come')


GROUPS = {'options': attack_options, 'arguments': attack_arguments, 'fixtures': attack_fixtures, 'folders': attack_folders,
          'signals': attack_signals, 'wire': attack_wire, 'panel': attack_panel}


def main():
    for name, group in GROUPS.items():
        if not ONLY or name in ONLY:
            started = time.monotonic()
            group()
            print(f'{name}: {time.monotonic() - started:.0f} s', flush=True)
    print('\n| attacked | tried | handled | not |\n| --- | ---: | ---: | ---: |')
    for name in tried:
        bad = len(missed.get(name, []))
        print(f'| {name} | {tried[name]} | {tried[name] - bad} | {bad} |')
    bad = sum(len(names) for names in missed.values())
    print(f'| **all** | {sum(tried.values())} | {sum(tried.values()) - bad} | {bad} |')
    os.chdir('/')
    return 1 if bad or not tried else 0


sys.exit(main())
