/** Shown when the server asks who is there. */
import { html, useRef, useState } from "../ui.js";
import { call } from "../api.js";
import { LOGIN } from "../texts.js";

/** `entered()` is called once the server has taken the token. */
export function Login({ entered }) {
  const field = useRef(null);
  const [problem, setProblem] = useState("");
  const submit = async (event) => {
    event.preventDefault();
    try {
      await call("session", { method: "POST", body: { token: field.current.value.trim() } });
      entered();
    } catch (error) {
      setProblem(error.status === 401 || error.status === 403 ? LOGIN.wrong : error.message);
      field.current.select();
    }
  };
  return html`
    <main class="gate">
      <form class="card" onSubmit=${submit}>
        <h1>${LOGIN.title}</h1>
        <p>${LOGIN.about}</p>
        <label for="token">${LOGIN.token}</label>
        <input ref=${field} id="token" name="token" type="password" autocomplete="current-password" required aria-describedby="token-problem" autofocus />
        <p id="token-problem" class="refusal" role="alert">${problem}</p>
        <button type="submit" class="listen">${LOGIN.enter}</button>
      </form>
    </main>
  `;
}
